"""`abu size`: an autobalancer sized, its design simulated from many start cases, judged and drawn."""
