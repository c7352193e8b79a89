"""Open benchmark: hard motions of autobalancers as neutral files, against which any simulator can be held."""
