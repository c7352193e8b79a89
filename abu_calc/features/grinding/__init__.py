"""`abu grinding`: a machine pressed to its workpiece, by steady contact and by simulation; wear of its wheel."""
