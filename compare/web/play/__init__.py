"""The page of one or two tosses, in the frame of a notebook; may import what pages share."""
