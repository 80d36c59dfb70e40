"""Sixteen cells at once: compared, copied and set by vector instructions.

Loops over sixteen cells of two arrays are compiled to the same instructions, but ask each time whether the arrays
overlap. Comparisons return a number of sixteen bits; `count_ones` and `lowest_bit` work on such numbers.
"""
# mypy: disable-error-code="no-untyped-def, no-untyped-call, call-arg"
# ruff: noqa: ANN001, ANN201, ANN202, ANN204, ARG001

from __future__ import annotations

from types import FunctionType, SimpleNamespace

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from infill.kernels.compiling import njit

SIXTEEN = 16
TRUE = ir.Constant(ir.IntType(1), 1)
NUMBER = ir.IntType(32)


@intrinsic
def mask_above(context, values, at, limit):
    """Return a number with bit n set where number `at` + n of sixteen is above the limit."""
    return _build_comparison(">", values)


@intrinsic
def mask_equal(context, values, at, limit):
    """Return a number with bit n set where number `at` + n of sixteen equals the limit."""
    return _build_comparison("==", values)


@intrinsic
def copy(context, target, to, source, at):
    """Copy sixteen numbers from one flat array to another of the same type."""

    def code(context, builder, signature, arguments):
        first, second = signature.args[0], signature.args[2]
        out, align = _vector_pointer(context, builder, first, arguments[0], arguments[1])
        start, _ = _vector_pointer(context, builder, second, arguments[2], arguments[3])
        builder.store(builder.load(start, align=align), out, align=align)
        return context.get_dummy_value()

    return types.void(target, types.int64, source, types.int64), code


@intrinsic
def spread(context, target, to, value):
    """Set sixteen numbers of a flat array to one value."""

    def code(context, builder, signature, arguments):
        out, align = _vector_pointer(context, builder, signature.args[0], arguments[0], arguments[1])
        builder.store(_broadcast(builder, arguments[2]), out, align=align)
        return context.get_dummy_value()

    return types.void(target, types.int64, target.dtype), code


class Lanes:
    """Sixteen numbers of single precision in a function during compilation: its operators build instructions."""

    def __init__(self, builder, value):
        self.builder, self.value = builder, value

    def __add__(self, other):
        return Lanes(self.builder, self.builder.fadd(self.value, other.value))

    def __sub__(self, other):
        return Lanes(self.builder, self.builder.fsub(self.value, other.value))

    def __mul__(self, other):
        return Lanes(self.builder, self.builder.fmul(self.value, other.value))

    def __truediv__(self, other):
        return Lanes(self.builder, self.builder.fdiv(self.value, other.value))

    def root(self):
        """Return the square roots."""
        kind = ir.FunctionType(self.value.type, [self.value.type])
        root = cgutils.get_or_insert_function(self.builder.module, kind, f"llvm.sqrt.v{SIXTEEN}f32")
        return Lanes(self.builder, self.builder.call(root, [self.value]))


def lanes_of(formula):
    """Turn a formula on numbers, compiled or not, into a function of `Lanes`; its only call may be `math.sqrt`."""
    plain = getattr(formula, "py_func", formula)
    return FunctionType(plain.__code__, {"math": SimpleNamespace(sqrt=Lanes.root)})


def load_lanes(context, builder, kind, array, at):
    """Load sixteen numbers of an array, of single precision or integer, from `at` on."""
    start, align = _vector_pointer(context, builder, kind, array, at)
    value = builder.load(start, align=align)
    if not isinstance(kind.dtype, types.Float):
        value = builder.sitofp(value, ir.VectorType(ir.FloatType(), SIXTEEN))
    return Lanes(builder, value)


def store_lanes(context, builder, kind, array, at, lanes):
    """Store sixteen numbers of an array, from `at` on."""
    start, align = _vector_pointer(context, builder, kind, array, at)
    builder.store(lanes.value, start, align=align)


def same_lanes(builder, number):
    """Return a vector that repeats a number sixteen times."""
    return Lanes(builder, _broadcast(builder, number))


def _build_comparison(how, values):
    """Return the signature and the code of a comparison with a number of the array's own type."""
    kind = values.dtype

    def code(context, builder, signature, arguments):
        start, align = _vector_pointer(context, builder, signature.args[0], arguments[0], arguments[1])
        compare = builder.fcmp_ordered if isinstance(kind, types.Float) else builder.icmp_signed
        matches = compare(how, builder.load(start, align=align), _broadcast(builder, arguments[2]))
        return builder.bitcast(matches, ir.IntType(SIXTEEN))

    return types.uint16(values, types.int64, kind), code


def _vector_pointer(context, builder, kind, array, at):
    """Return a pointer to sixteen numbers of an array, as a vector, and their alignment."""
    vector = ir.VectorType(context.get_data_type(kind.dtype), SIXTEEN)
    start = builder.gep(context.make_array(kind)(context, builder, array).data, [at])
    return builder.bitcast(start, vector.as_pointer()), kind.dtype.bitwidth // 8


def _broadcast(builder, value):
    """Return a vector of one value."""
    vector = ir.VectorType(value.type, SIXTEEN)
    none = ir.Constant(vector, ir.Undefined)
    single = builder.insert_element(none, value, NUMBER(0))
    return builder.shuffle_vector(single, none, ir.Constant(ir.VectorType(NUMBER, SIXTEEN), [0] * SIXTEEN))


@intrinsic
def popcount(context, bits):
    """Count the set bits, by the machine instruction for it."""
    return types.int64(types.int64), lambda _, builder, __, arguments: builder.ctpop(arguments[0])


@intrinsic
def count_trailing_zeros(context, bits):
    """Count the bits below the lowest set bit."""
    return types.int64(types.int64), lambda _, builder, __, arguments: builder.cttz(arguments[0], TRUE)


@njit(inline="always", cache=True)
def count_ones(bits):
    """Count the set bits of a non-negative number."""
    return popcount(np.int64(bits))


@njit(inline="always", cache=True)
def lowest_bit(bits):
    """Return the position of the lowest set bit."""
    return count_trailing_zeros(np.int64(bits))
