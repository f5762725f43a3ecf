"""The statements of the paper, judged on the atlases of its rotors (README.md)."""
