"""Files written whole or not at all, their names, and readers in a process of their own."""
