"""``python -m lagrangian`` is the command."""

from lagrangian.cli import run

if __name__ == "__main__":
    run()
