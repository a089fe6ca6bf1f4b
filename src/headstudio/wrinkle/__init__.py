"""Expressive and fine wrinkles (Bando's thesis 2003, chapter 2)."""
