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
