"""What `cointoss reproduce` makes: the paper's figures and claims, and studies; imports the rooms below."""
