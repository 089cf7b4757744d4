"""What `cointoss reproduce` makes: each module here is one figure or study."""
