"""Statistical wisps and the styler (Choe, Ko 2005)."""
