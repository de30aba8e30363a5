// A frame that moves or is not done, as ImageData, whatever it came as.
import { readPpm } from "./ppm.js";

/// `answer`: fetch's, of a PPM or what a browser decodes.
export async function readFrame(answer) {
  if (answer.headers.get("Content-Type") === "image/x-portable-pixmap") return readPpm(await answer.arrayBuffer());
  const decoded = await createImageBitmap(await answer.blob());
  const paper = new OffscreenCanvas(decoded.width, decoded.height).getContext("2d");
  paper.drawImage(decoded, 0, 0);
  return paper.getImageData(0, 0, decoded.width, decoded.height);
}

const most_pixels = 1e6;

/// {width, height} of a frame in place of a picture so large, as large as that times `scale` or as frames may be.
export function frameSize({ width, height }, scale = 1) {
  const part = scale * Math.min(1, Math.sqrt(most_pixels / (width * height)));
  const [across, down] = [width, height].map((length) => Math.max(1, Math.round(length * part)));
  return { width: across, height: down };
}
