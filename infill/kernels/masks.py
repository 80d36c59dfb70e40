"""Sixteen cells compared at once, by one vector instruction, whose outcome is a number of sixteen bits; and bits."""
# mypy: disable-error-code="no-untyped-def, no-untyped-call, call-arg"
# ruff: noqa: ANN001, ANN201, ANN202, ARG001

from __future__ import annotations

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from infill.kernels.compiling import njit

SIXTEEN = 16
TRUE = ir.Constant(ir.IntType(1), 1)


@intrinsic
def above(context, values, at, limit):
    """Return which of sixteen numbers, from `at` on, are above the limit, the first one as the lowest bit."""
    return _compared(">", values, at)


@intrinsic
def equal(context, values, at, limit):
    """Return which of sixteen numbers, from `at` on, equal the limit, the first one as the lowest bit."""
    return _compared("==", values, at)


def _compared(how, values, at):
    """Return the signature and the code of a comparison with a number of the array's own type."""
    kind = values.dtype
    signature = types.uint16(values, types.int64, kind)

    def code(context, builder, signature, arguments):
        array, first, limit = arguments
        element = context.get_data_type(kind)
        vector = ir.VectorType(element, SIXTEEN)
        start = builder.gep(context.make_array(values)(context, builder, array).data, [first])
        loaded = builder.load(builder.bitcast(start, vector.as_pointer()), align=kind.bitwidth // 8)
        none = ir.Constant(vector, ir.Undefined)
        one = builder.insert_element(none, limit, ir.Constant(ir.IntType(32), 0))
        everywhere = builder.shuffle_vector(
            one, none, ir.Constant(ir.VectorType(ir.IntType(32), SIXTEEN), [0] * SIXTEEN)
        )
        compare = builder.fcmp_ordered if isinstance(kind, types.Float) else builder.icmp_signed
        return builder.bitcast(compare(how, loaded, everywhere), ir.IntType(SIXTEEN))

    return signature, code


@intrinsic
def counted(context, bits):
    """Count the set bits, by the machine instruction for it."""
    return types.int64(types.int64), lambda _, builder, __, arguments: builder.ctpop(arguments[0])


@intrinsic
def trailing(context, bits):
    """Count the bits below the lowest set bit."""
    return types.int64(types.int64), lambda _, builder, __, arguments: builder.cttz(arguments[0], TRUE)


@njit(inline="always", cache=True)
def ones(bits):
    """Count the set bits of a non-negative number."""
    return counted(np.int64(bits))


@njit(inline="always", cache=True)
def lowest(bits):
    """Return the position of the lowest set bit."""
    return trailing(np.int64(bits))
