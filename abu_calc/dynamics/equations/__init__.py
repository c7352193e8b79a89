"""Equations of motion of any scene: one set, and the order in which its parts are evaluated.

    y = (q, q', θ, θ', states of effects, turn, speed)
        │
        ├─ right_hand_side.motion_of     where everything is: e_r, e_t, γ' of the balls         → Motion
        ├─ Effect.move                   each effect may change that (a race off its axis)      → Motion
        ├─ Geometry.levers               what balls feel of the frame's accelerations A         → Levers
        ├─ Effect.act                    what each effect adds: forces, directions, constraints → Levers, Loads
        ├─ elimination.solve_all         balls eliminated, d equations for A, then back         → Solved
        └─ right_hand_side.derivative    Effect.rates for states of effects                     → y'

    assemble     Scene → Parameters: every number, combined once; → Equations, ready to integrate; ∂y'/∂y, exact
    elimination  balls eliminated; small systems by plain arithmetic

The same arithmetic serves numbers, complex numbers (exact derivatives) and symbols (`codegen`). Modes of effects come
beside the numbers, as `Acting`. What is watched for events is computed from `Solved` by `switching.modes.watched`.
"""
