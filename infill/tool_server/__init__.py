"""The commands as tools for assistants: a server of the Model Context Protocol, over stdin and stdout."""
