"""What `cointoss reproduce` makes: the paper's figures, its claims, studies; imports the rooms below."""
