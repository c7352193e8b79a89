"""Many machines like one: what is asked, its members, their store, the answers."""
