"""Kinds of support, one file each; every one answers by the face in `dynamics.support`.

linear.py      springs, dampers, masses: what all linear supports share
planar.py      a point mass on springs        body.py    with a further body on it      hands.py   held in two hands
tilting.py     a rigid rotor on bearings      swing_arm.py   at the end of an arm

A new kind is a file here, its table in `spec.scene_support`, its key in `spec.scene`, and its line in
`scenes.from_scene.SUPPORTS`.
"""
