"""Run the command line: `cointoss`, or `python -m cointoss`; nothing else imports this module."""

import atexit
import gc
import os
import signal

if signal.getsignal(signal.SIGINT) == signal.default_int_handler:
    # No traceback, until cointoss.compare.output.interruption has its own handler.
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def main() -> None:
    """Run the command line."""
    # Each core would have a thread for NumPy's products of matrices, which spins until it has work.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # What is imported stays: the collector need not look through it again and again, nor at the end.
    gc.set_threshold(100_000)
    atexit.register(gc.freeze)
    from cointoss.compare.cli import main as run

    run()


if __name__ == "__main__":
    main()
