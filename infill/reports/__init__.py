"""The declaration of every report: its keys, their types and their meanings, one module for each command."""
