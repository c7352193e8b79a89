"""Simulation of scenes: scenes of designs and files, start cases, one run and its response, ensembles."""
