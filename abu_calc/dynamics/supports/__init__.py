"""Kinds of support, one file each; every one answers by the interface in `dynamics.support`.

planar.py      springs, dampers, masses: a point mass on springs, with a further body on it, or held in two hands
tilting.py     a rigid rotor on bearings
swing_arm.py   a rotor at the end of an arm
pressed.py     remarks on a wheel pressed to its workpiece
receptance.py  steady motion of any support without balls

A new kind is a file here, which declares its tables in scene files, too, and its line in `registry.py`.
"""
