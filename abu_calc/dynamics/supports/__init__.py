"""kinds.py: what a support is; the other files turn springs, masses and dampers of a machine into one."""
