"""What is tossed, and what both engines must mean alike; imports none of the other three packages."""

from pathlib import Path
from runpy import run_path

# Its clock starts before other modules are read.
from models.kernel import sources as sources

run_path(str(Path(__file__).with_name("siblings.py")))
