// Matplotlib's viridis: even to the eye, and in greys.

const VIRIDIS = [
  0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e, 0x1f988b, 0x22a884, 0x35b779,
  0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725,
];

/** [size][4] bytes, red first. */
export function colourTable(size: number): Uint8Array {
  const table = new Uint8Array(4 * size);
  for (let i = 0; i < size; ++i) {
    const at = (i / (size - 1)) * (VIRIDIS.length - 1);
    const [below, above] = [VIRIDIS[Math.floor(at)], VIRIDIS[Math.ceil(at)]];
    for (let channel = 0; channel < 3; ++channel) {
      const shift = 16 - 8 * channel;
      const [a, b] = [(below >> shift) & 255, (above >> shift) & 255];
      table[4 * i + channel] = Math.round(a + (at % 1) * (b - a));
    }
    table[4 * i + 3] = 255;
  }
  return table;
}

export const gradient = () => {
  const stops = VIRIDIS.map((colour) => `#${colour.toString(16).padStart(6, "0")}`);
  return `linear-gradient(to right, ${stops.join(", ")})`;
};
