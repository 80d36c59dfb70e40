"""The studio: a page in the browser, and a server on this machine that answers it by calls of the library."""
