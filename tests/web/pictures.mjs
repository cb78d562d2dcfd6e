// Compares pictures as arrays of bytes.
import assert from 'node:assert/strict';

// Peak signal to noise ratio. The pictures must show something.
export function decibels(expected, drawn) {
  assert.equal(drawn.length, expected.length);
  let squares = 0;
  let sum = 0;
  let sum_of_squares = 0;
  drawn.forEach((value, i) => {
    squares += (value - expected[i]) ** 2;
    sum += value;
    sum_of_squares += value * value;
  });
  const deviation = Math.sqrt(sum_of_squares / drawn.length - (sum / drawn.length) ** 2);
  assert.ok(deviation > 20, 'there is something to compare');
  return 10 * Math.log10(255 ** 2 * drawn.length / squares);
}
