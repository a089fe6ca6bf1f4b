"""The tools of the viewport."""
