"""The explorer: one self-contained HTML file of an atlas, with the solver in it (`rubatlas-report`)."""
