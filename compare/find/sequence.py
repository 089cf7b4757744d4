"""What a sequence of faces is, without what finds one."""


def sequence_of(text: str) -> str:
    """Return a sequence of faces, such as "HTTH".

    Raises:
        ValueError: saying what is accepted.
    """
    if not isinstance(text, str) or set(text) - {"H", "T"}:
        raise ValueError("letters H and T, such as HTTH")
    return text
