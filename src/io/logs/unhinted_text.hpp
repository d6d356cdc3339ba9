// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cairo.h>

#include <memory>

namespace cca {

/// Lets a context draw glyphs as they are. Hinted ones depend on what the program drew before, and
/// the same map has to give the same bytes.
inline void drawUnhinted(cairo_t* pen) {
  const std::unique_ptr<cairo_font_options_t, void (*)(cairo_font_options_t*)> options(
      cairo_font_options_create(), cairo_font_options_destroy);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(pen, options.get());
}

}  // namespace cca
