"""The commands of `cointoss`, a module each; imports the rest of compare only as a command runs."""
