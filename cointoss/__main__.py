"""Run the command line: `python -m cointoss`."""

from compare.cli import main

if __name__ == "__main__":
    main()
