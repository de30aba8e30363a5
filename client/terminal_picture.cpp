// The one file with chafa, which draws, and GLib, in whose types it speaks.
#include "client/terminal_picture.h"

#include <chafa.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "client/failure.h"
#include "client/image_format.h"
#include "client/png.h"

namespace raytracer::client {
namespace {

template <auto release>
struct Release {
  template <typename T>
  void operator()(T* object) const {
    release(object);
  }
};
using TerminalInfo = std::unique_ptr<ChafaTermInfo, Release<chafa_term_info_unref>>;
using Config = std::unique_ptr<ChafaCanvasConfig, Release<chafa_canvas_config_unref>>;
using Canvas = std::unique_ptr<ChafaCanvas, Release<chafa_canvas_unref>>;
using SymbolMap = std::unique_ptr<ChafaSymbolMap, Release<chafa_symbol_map_unref>>;

/// Knows no sequence at all where the terminal takes none.
TerminalInfo terminal_info() {
  if (!takes_control_sequences()) return TerminalInfo(chafa_term_info_new());
  gchar** environment = g_get_environ();
  const auto variable = [&](const char* name) {
    const gchar* const value = g_environ_getenv(environment, name);
    return std::string_view(value == nullptr ? "" : value);
  };
  // chafa 1.12 knows kitty by TERM only, and not Ghostty, which takes the same images. In tmux the
  // variables of the terminal around it are left, but no images get through.
  const bool takes_kitty_images =
      variable("TERM") == "xterm-ghostty" || !variable("KITTY_WINDOW_ID").empty();
  if (takes_kitty_images && variable("TMUX").empty())
    environment = g_environ_setenv(environment, "TERM", "xterm-kitty", TRUE);
  TerminalInfo info(chafa_term_db_detect(chafa_term_db_get_default(), environment));
  g_strfreev(environment);
  return info;
}

bool takes(const TerminalInfo& info, ChafaTermSeq sequence) {
  return chafa_term_info_have_seq(info.get(), sequence) != FALSE;
}

ChafaPixelMode pixel_mode(const TerminalInfo& info) {
  if (takes(info, CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1)) return CHAFA_PIXEL_MODE_KITTY;
  if (takes(info, CHAFA_TERM_SEQ_BEGIN_ITERM2_IMAGE)) return CHAFA_PIXEL_MODE_ITERM2;
  if (takes(info, CHAFA_TERM_SEQ_BEGIN_SIXELS)) return CHAFA_PIXEL_MODE_SIXELS;
  return CHAFA_PIXEL_MODE_SYMBOLS;
}

/// Of cells; images have all their colours in any case.
ChafaCanvasMode color_mode(const TerminalInfo& info) {
  if (takes(info, CHAFA_TERM_SEQ_SET_COLOR_FGBG_DIRECT)) return CHAFA_CANVAS_MODE_TRUECOLOR;
  if (takes(info, CHAFA_TERM_SEQ_SET_COLOR_FGBG_256)) return CHAFA_CANVAS_MODE_INDEXED_240;
  if (takes(info, CHAFA_TERM_SEQ_SET_COLOR_FGBG_16)) return CHAFA_CANVAS_MODE_INDEXED_16;
  return CHAFA_CANVAS_MODE_FGBG;
}

Config configuration(const TerminalInfo& info, ImageSize image, const TerminalSize& window) {
  Config config(chafa_canvas_config_new());
  const ChafaPixelMode pixels = pixel_mode(info);
  const bool as_image = pixels != CHAFA_PIXEL_MODE_SYMBOLS;
  chafa_canvas_config_set_pixel_mode(config.get(), pixels);
  chafa_canvas_config_set_canvas_mode(config.get(),
                                      as_image ? CHAFA_CANVAS_MODE_TRUECOLOR : color_mode(info));
  if (!takes_control_sequences()) {
    const SymbolMap symbols(chafa_symbol_map_new());
    chafa_symbol_map_add_by_tags(symbols.get(), CHAFA_SYMBOL_TAG_ASCII);
    chafa_canvas_config_set_symbol_map(config.get(), symbols.get());
  }
  const int own_columns =
      as_image ? (image.width_px + window.column_px - 1) / window.column_px : image.width_px;
  int columns = std::min(window.columns, own_columns);
  int rows = std::max(window.rows, 1);
  chafa_calc_canvas_geometry(
      image.width_px, image.height_px, &columns, &rows,
      static_cast<float>(window.column_px) / static_cast<float>(window.row_px), FALSE, FALSE);
  chafa_canvas_config_set_geometry(config.get(), columns, rows);
  chafa_canvas_config_set_cell_geometry(config.get(), window.column_px, window.row_px);
  return config;
}

/// What is drawn: rows of pixels, with an alpha channel or without.
struct Pixels {
  ImageSize size;
  ChafaPixelType type;
  std::size_t pixel_bytes;
  const unsigned char* bytes;
};

Pixels pixels_of_ppm(std::string_view image) {
  const std::optional<NetpbmHeader> header = netpbm_header(image, "P6");
  if (!header) throw ServerError("the server's answer is not the image that was asked for");
  const std::string_view raster = image.substr(header->length);
  const auto [width, height] = header->size;
  if (raster.size() != 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw ServerError("the server's image is not whole");
  return {header->size, CHAFA_PIXEL_RGB8, 3, reinterpret_cast<const unsigned char*>(raster.data())};
}

std::string drawn(const Pixels& pixels, const TerminalSize& window) {
  const ImageSize size = pixels.size;
  const std::size_t row_bytes = pixels.pixel_bytes * static_cast<std::size_t>(size.width_px);
  const TerminalInfo info = terminal_info();
  const Canvas canvas(chafa_canvas_new(configuration(info, size, window).get()));
  chafa_canvas_draw_all_pixels(canvas.get(), pixels.type, pixels.bytes, size.width_px,
                               size.height_px, static_cast<int>(row_bytes));
  GString* const printed = chafa_canvas_print(canvas.get(), info.get());
  std::string text(printed->str, printed->len);
  g_string_free(printed, TRUE);
  return text + '\n';
}

}  // namespace

std::string terminal_picture(std::string_view image, const TerminalSize& window) {
  if (const std::optional<PngPixels> png = decode_png(image))
    return drawn({png->size, CHAFA_PIXEL_RGBA8_UNASSOCIATED, 4, png->rgba.data()}, window);
  return drawn(pixels_of_ppm(image), window);
}

}  // namespace raytracer::client
