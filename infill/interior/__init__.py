"""The inside of a part: its signed distance, open faces, gradings, cells that follow its shape."""
