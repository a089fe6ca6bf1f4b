"""Loosely connected particles: Bando, Chen, Nishita 2006, and chapter 3 of Bando's thesis of 2003."""
