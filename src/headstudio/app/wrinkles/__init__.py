"""The editor of wrinkles: furrows, fine lines, tissue and expressions of a living face (Bando's thesis, chapter 2)."""
