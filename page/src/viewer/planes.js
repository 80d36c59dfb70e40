/** Numbers from planes of bytes, the lowest first, as `split_bytes` of `infill/viewer/compact.py` writes them. */

/**
 * Read a difference of 16 bits whose sign is in the lowest bit.
 *
 * @param {Uint8Array} planes
 * @param {number} count Numbers in a column.
 * @param {number} columns
 * @param {number} column
 * @param {number} row
 */
export function readDifference(planes, count, columns, column, row) {
  const coded = planes[column * count + row] | (planes[(column + columns) * count + row] << 8);
  return (coded >> 1) ^ -(coded & 1);
}
