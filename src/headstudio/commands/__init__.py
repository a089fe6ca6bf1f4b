"""What the commands do. ``headstudio.cli`` turns words into arguments; the work is here, a file for each command."""
