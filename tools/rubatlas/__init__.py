"""Reads, queries and draws atlases of a rotor with rubbing blades, which the program rubatlas computes."""
