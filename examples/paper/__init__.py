"""The paper, figure by figure: ``python -m examples.paper.fig02_fidelity [folder] [--small]``, or ``make paper``.

Wang, Li, Choi, Lee, Kim, "Fast and accurate smoothing method using a modified Allen-Cahn equation", Computer-Aided
Design 120 (2020) 102804. Each script writes one picture and its numbers; read in order they are a course in the method.
Lengths and parameters are the paper's unless a line says otherwise: no unit, h the cell size, dt = h² / 7, eps_2.
"""
