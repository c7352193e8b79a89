"""Kinds of support, one file each; every one answers by the face in `dynamics.support`.

planar.py     springs, dampers, masses: a point mass on springs, with a further body on it, or held in two hands
pressed.py    an arm pressed to its workpiece
tilting.py    a rigid rotor on bearings      swing_arm.py   at the end of an arm

A new kind is a file here, its table in `inputs.scene_parts`, its key in `inputs.scene`, and its line in
`simulation.scene_of_file.SUPPORTS`.
"""
