"""Loops of `infill.partition.fields`, compiled: the winning label of every cell, and by how much labels win or lose."""
# mypy: disable-error-code="no-untyped-def, call-arg, var-annotated"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.sparse import B0, B1, B2

PARTS = 2.0**30  # of a cell, in which shares of cells are counted: sums are exact in any order
I_FACTOR, J_FACTOR, K_FACTOR = (
    np.uint64(0x9E3779B97F4A7C15),
    np.uint64(0xC2B2AE3D27D4EB4F),
    np.uint64(0x165667B19E3779F9),
)
INSIDE = -1  # slot of a brick that lies whole inside its label
# Value beyond the interface of a label, where it never wins, whatever its offset: a small label with a large offset
# would else come back at the walls of others.
BEYOND, NEVER = np.float32(-0.999), np.float32(-8.0)


@njit(from_python=False, nogil=True, cache=True)
def raise_value(values, slot, cell, offset):
    """Return the value of a brick's cell, raised by the offset of its label."""
    value = np.float32(1.0) if slot == INSIDE else values[slot, cell]
    return value + (NEVER if value <= BEYOND else offset)


@njit(nogil=True, cache=True)
def choose_winners(entries, labels, slots, values, offsets, numbers, winners, thread, threads):
    """Write the label with the highest value plus offset of every cell; of equal ones, the given label of the cell.

    Parameters
    ----------
    entries : (m0, m1, m2, 2) int64
        First and last entry, exclusive, of each brick of the lattice in `labels` and `slots`.
    labels, slots : (e,) int32
        Label of an entry, and its brick in `values`, or INSIDE.
    values : (n, CELLS) float32
    offsets : (labels,) float32
    numbers, winners : (n0, n1, n2) uint16
    """
    n0, n1, n2 = numbers.shape
    for p in range(thread, entries.shape[0], threads):
        for q in range(entries.shape[1]):
            for r in range(entries.shape[2]):
                begin, end = entries[p, q, r, 0], entries[p, q, r, 1]
                for a in range(B0):
                    i = p * B0 + a - 1
                    if i < 0 or i >= n0:
                        continue
                    for b in range(B1):
                        j = q * B1 + b - 1
                        if j < 0 or j >= n1:
                            continue
                        for c in range(B2):
                            k = r * B2 + c - 1
                            if k < 0 or k >= n2:
                                continue
                            own_label = numbers[i, j, k]
                            if end - begin == 1:
                                winners[i, j, k] = labels[begin]
                                continue
                            best, best_value = own_label, np.float32(-1e30)
                            cell = (a * B1 + b) * B2 + c
                            for entry in range(begin, end):
                                label, slot = labels[entry], slots[entry]
                                value = raise_value(values, slot, cell, offsets[label])
                                if value > best_value or (value == best_value and label == own_label):
                                    best, best_value = label, value
                            winners[i, j, k] = best


@njit(inline="always", cache=True)
def place_hash(i, j, k):
    """Return a number that depends on a place alone, and not evenly."""
    number = np.uint64(i) * I_FACTOR ^ np.uint64(j) * J_FACTOR ^ np.uint64(k) * K_FACTOR
    number ^= number >> np.uint64(29)
    number *= I_FACTOR
    return number ^ (number >> np.uint64(32))


@njit(nogil=True, cache=True)
def count_margins(entries, labels, slots, values, numbers, box, bins, thread, threads):
    """Count by how much the value of every label exceeds the highest other one in its cells.

    Parameters
    ----------
    own : (2, 3) int64
        The first brick whose cells count, and the one after the last.
    bins : (threads, labels, n) int64
        Added to: margins from -2 to 2 fall into n bins.
    """
    n0, n1, n2 = numbers.shape
    largest = bins.shape[2] - 1
    for p in range(box[0, 0] + thread, box[1, 0], threads):
        for q in range(box[0, 1], box[1, 1]):
            for r in range(box[0, 2], box[1, 2]):
                begin, end = entries[p, q, r, 0], entries[p, q, r, 1]
                for a in range(B0):
                    for b in range(B1):
                        for c in range(B2):
                            i, j, k = p * B0 + a - 1, q * B1 + b - 1, r * B2 + c - 1
                            if i < 0 or j < 0 or k < 0 or i >= n0 or j >= n1 or k >= n2:
                                continue
                            own_label = numbers[i, j, k]
                            cell = (a * B1 + b) * B2 + c
                            label_value = rival = np.float32(-1.0)
                            for entry in range(begin, end):
                                slot = slots[entry]
                                value = np.float32(1.0) if slot == INSIDE else values[slot, cell]
                                if labels[entry] == own_label:
                                    label_value = value
                                else:
                                    rival = max(rival, value)
                            place = np.int64((label_value - rival + 2.0) / 4.0 * bins.shape[2])
                            bins[thread, own_label, min(max(place, 0), largest)] += 1


@njit(nogil=True, cache=True)
def share_cells(
    entries, labels, slots, values, offsets, numbers, box, corner, ramp, stride, shares, pairs, thread, threads
):
    """Share every cell between the two labels with the highest values; return the number of samples.

    A cell is the winner's from a lead of `ramp` on, and half its own without a lead: summed along a wall, shares are
    the volume behind it, and they change without jumps.

    Parameters
    ----------
    entries, labels, slots, values, offsets, numbers
        As for `choose_winners`.
    own : (2, 3) int64
        See `count_margins`.
    corner : (3,) int64
        The first cell, in the whole grid.
    ramp : float
    stride : uint64
        One of so many shared cells is a sample, by its place in the whole grid.
    shares : (threads, labels) int64
        Added to: parts of cells, see `PARTS`.
    pairs : (threads, K) uint32
        The two labels of samples, winner first: the first has the higher 16 bits.
    """
    n0, n1, n2 = numbers.shape
    samples, whole = 0, np.int64(PARTS)
    for p in range(box[0, 0] + thread, box[1, 0], threads):
        for q in range(box[0, 1], box[1, 1]):
            for r in range(box[0, 2], box[1, 2]):
                begin, end = entries[p, q, r, 0], entries[p, q, r, 1]
                i0, i1 = max(p * B0 - 1, 0), min(p * B0 + B0 - 1, n0)
                j0, j1 = max(q * B1 - 1, 0), min(q * B1 + B1 - 1, n1)
                k0, k1 = max(r * B2 - 1, 0), min(r * B2 + B2 - 1, n2)
                if end - begin == 1:
                    shares[thread, labels[begin]] += whole * max(i1 - i0, 0) * max(j1 - j0, 0) * max(k1 - k0, 0)
                    continue
                for i in range(i0, i1):
                    for j in range(j0, j1):
                        for k in range(k0, k1):
                            cell = ((i + 1 - p * B0) * B1 + j + 1 - q * B1) * B2 + k + 1 - r * B2
                            best = second = np.int64(numbers[i, j, k])
                            best_value = second_value = np.float32(-1e30)
                            for entry in range(begin, end):
                                label, slot = np.int64(labels[entry]), slots[entry]
                                value = raise_value(values, slot, cell, offsets[label])
                                if value > best_value:
                                    second, second_value = best, best_value
                                    best, best_value = label, value
                                elif value > second_value:
                                    second, second_value = label, value
                            lead = best_value - second_value
                            if lead >= ramp:
                                shares[thread, best] += whole
                                continue
                            share = np.int64((0.5 + 0.5 * lead / ramp) * PARTS)
                            shares[thread, best] += share
                            shares[thread, second] += whole - share
                            name = place_hash(i + corner[0], j + corner[1], k + corner[2])
                            if name % stride != 0:
                                continue
                            if samples < pairs.shape[1]:
                                pairs[thread, samples] = (np.uint32(best) << 16) | np.uint32(second)
                                samples += 1
    return samples


@njit(nogil=True, cache=True)
def find_uniform(bricks, uniform):
    """Write 1 or -1 for each brick (n, CELLS) that holds that value throughout, else 0: uniform (n,) int8."""
    for n in range(len(bricks)):
        first = bricks[n, 0]
        uniform[n] = np.int8(first) if abs(first) == 1 else 0
        for cell in range(bricks.shape[1]):
            if bricks[n, cell] != first:
                uniform[n] = 0
                break
