// How a picture differs from another, made visible: each channel's distance, many times enlarged.

/// `a`, `b`: ImageData of one size. Grey is no difference, brighter is more, darker is less.
export function differenceOf(a, b, gain) {
  const image = new ImageData(a.width, a.height);
  for (let at = 0; at < image.data.length; at += 4) {
    for (let channel = at; channel < at + 3; channel += 1)
      image.data[channel] = 128 + gain * (a.data[channel] - b.data[channel]);
    image.data[at + 3] = 255;
  }
  return image;
}
