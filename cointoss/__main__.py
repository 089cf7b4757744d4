"""Run the command line: `python -m cointoss`."""

from cointoss.compare.cli import main

if __name__ == "__main__":
    main()
