"""Run the command line: `cointoss`, or `python -m cointoss`; nothing else imports this module."""

import signal

if signal.getsignal(signal.SIGINT) == signal.default_int_handler:
    # No traceback, until cointoss.compare.output.interruption has its own handler.
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def main() -> None:
    """Run the command line."""
    from cointoss.compare.cli import main as run

    run()


if __name__ == "__main__":
    main()
