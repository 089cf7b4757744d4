"""Modules that a test writes."""


def write(folder, module, source):
    """Write the source of a module below a folder, by its full name."""
    file = folder.joinpath(*module.split(".")).with_suffix(".py")
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(source)
    # Python would run it for any source of the same length and of the same second.
    for bytecode in file.parent.glob(f"__pycache__/{file.stem}.*.pyc"):
        bytecode.unlink()
