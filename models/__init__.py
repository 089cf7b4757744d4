"""The description of a toss, which both engines share; imports none of the other three packages."""

if __name__ == "models":  # by its bare name, in a checkout
    from cointoss.bare_names import open_as_part

    open_as_part(__name__)
