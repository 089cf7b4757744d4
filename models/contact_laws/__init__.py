"""The contact laws, one a file, each with one record of what holds of it; imports the kernel and words."""
