// A binary PPM (P6, 8 bits), as ImageData. Moving frames come so: neither side spends time on
// compressing what is seen for a twentieth of a second.

/// `bytes`: an ArrayBuffer. Throws if it holds anything else.
export function readPpm(bytes) {
  const start = new TextDecoder("latin1").decode(bytes.slice(0, 64));
  const head = /^P6\s(\d+)\s(\d+)\s255\s/.exec(start);
  if (!head) throw new Error("a frame is not a P6 of 8 bits");
  const width = Number(head[1]);
  const height = Number(head[2]);
  const from = new Uint8Array(bytes, head[0].length);
  const image = new ImageData(width, height);
  const words = new Uint32Array(image.data.buffer);
  for (let pixel = 0, at = 0; pixel < words.length; pixel += 1, at += 3)
    words[pixel] = 0xff000000 | (from[at + 2] << 16) | (from[at + 1] << 8) | from[at];
  return image;
}
