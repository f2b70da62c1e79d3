"use strict";
// A module of WebAssembly from its columns: the inverse of columns.py, which says what they are.

/** @param {Uint8Array} packed  @returns {Uint8Array} */
function fromColumns(packed) {
  let at = 0;
  const size = () => {
    let value = 0, shift = 0, byte;
    do { byte = packed[at++]; value |= (byte & 127) << shift; shift += 7; } while (byte > 127);
    return value;
  };
  const lengths = Array.from({ length: size() }, size);
  if (!lengths.length) return packed.subarray(at);
  const starts = lengths.map((length) => (at += length) - length);
  const made = new Uint8Array(lengths.reduce((sum, length) => sum + length));
  const [OPCODES, LOCALS, MORE_OF_LOCALS, OFFSETS, MORE_OF_OFFSETS, CONSTANTS, REST] = lengths.keys();
  let end = 0;
  const take = (column, count = 1) => {
    const first = packed[starts[column]];
    while (count-- > 0) made[end++] = packed[starts[column]++];
    return first;
  };
  const number = (first, more = first) => {
    let byte = take(first), value = byte & 127, shift = 7;
    for (; byte > 127; shift += 7) { byte = take(more); value |= (byte & 127) << shift; }
    return value;
  };
  const place = () => { number(REST); number(OFFSETS, MORE_OF_OFFSETS); };
  const vector = (code) => {
    if (code < 12 || (code > 83 && code < 94)) { place(); if (code > 83 && code < 92) take(REST); }
    else if (code < 14) take(CONSTANTS, 16);
    else if (code > 20 && code < 35) take(REST);
  };
  const instruction = (code) => {
    if (code > 0x1f && code < 0x23) number(LOCALS, MORE_OF_LOCALS);
    else if (code > 0x27 && code < 0x3f) place();
    else if (code === 0x41 || code === 0x42) number(CONSTANTS);
    else if (code === 0x44) take(CONSTANTS, 8);
    else if ([0x0c, 0x0d, 0x10, 0x23, 0x24].includes(code)) number(REST);
    else if (code > 1 && code < 5) take(REST);
    else if (code === 0x11) { number(REST); number(REST); }
    else if (code === 0x0e) for (let n = number(REST); n >= 0; n--) number(REST);
    else if (code === 0xfd) vector(number(OPCODES));
    else if (code === 0xfc) { const which = number(OPCODES); if (which > 9) take(REST, 12 - which); }
  };
  take(REST, 8);
  while (end < made.length) {
    const section = take(REST), bytes = number(REST);
    if (section !== 10) { take(REST, bytes); continue; }
    for (let n = number(REST); n > 0; n--) {
      const length = number(REST), last = end + length;
      for (let groups = number(REST); groups > 0; groups--) { number(REST); take(REST); }
      while (end < last) instruction(take(OPCODES));
    }
  }
  return made;
}
