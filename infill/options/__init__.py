"""Options from keywords, assignments and files."""
