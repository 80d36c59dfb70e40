"""A volume in chunks: each is smoothed with a margin, gives its piece of surface, and adds to the sums of the whole."""
