"""What things cost: every stage of the animation, beside yardsticks that a reader can repeat."""
