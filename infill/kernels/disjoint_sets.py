"""Disjoint sets of nodes, joined one pair after another (union-find), and those of the vertices of triangles.

`parent` leads from every node to an earlier one of its set, and from the first node of the set to itself; `root`
follows it, halving the path as it goes, and `join` puts the later root under the earlier one, so that the first member
names the set.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit


@njit(cache=True)
def root(parent, n):
    """Return the first member of the set that contains `n`."""
    while parent[n] != n:
        parent[n] = parent[parent[n]]
        n = parent[n]
    return n


@njit(cache=True)
def join(parent, a, b):
    """Merge two sets; the first member stays the first."""
    a, b = root(parent, a), root(parent, b)
    if a < b:
        parent[b] = a
    elif b < a:
        parent[a] = b


@njit(nogil=True, cache=True)
def name_sets(parent, names):
    """Name the sets 0, 1, 2 … in the order of their first members; return their number."""
    count = 0
    for n in range(len(parent)):
        first_member = root(parent, n)
        if first_member == n:
            names[n] = count
            count += 1
        else:
            names[n] = names[first_member]
    return count


@njit(nogil=True, cache=True)
def join_faces(faces, parent, used):
    """Join the corners of every triangle, and mark them."""
    for f in range(len(faces)):
        used[faces[f, 0]] = used[faces[f, 1]] = used[faces[f, 2]] = True
        join(parent, np.int64(faces[f, 0]), np.int64(faces[f, 1]))
        join(parent, np.int64(faces[f, 0]), np.int64(faces[f, 2]))
