// Sorting items into the bins of a 2-D grid in parallel, an item into as many bins as it touches.
//
// Scattering into very many bins misses the caches at every item, so items go to bands of rows
// first, and each band is then sorted within them by one thread (a radix sort from the most
// significant digit). The result does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "engine/math/parts.h"
#include "engine/memory/page_allocator.h"
#include "engine/parallel/chunks.h"

namespace raytracer {

/// Cells begin <= index < end of a grid.
struct CellRectangle {
  int x_begin = 0;
  int y_begin = 0;
  int x_end = 0;
  int y_end = 0;

  bool empty() const { return x_begin >= x_end || y_begin >= y_end; }
  /// Of one that is not empty.
  std::size_t cell_count() const {
    return static_cast<std::size_t>(x_end - x_begin) * static_cast<std::size_t>(y_end - y_begin);
  }
};

/// A grid of `columns` x `rows` bins, each of 2^cells_log2 x 2^cells_log2 cells.
struct BinGrid {
  int columns;
  int rows;
  int cells_log2;

  std::size_t bin_count() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }

  /// The bins that a rectangle of cells, not empty, touches.
  CellRectangle bins_of(const CellRectangle& cells) const {
    const auto begin = [&](int cell) { return cell >> cells_log2; };
    const auto end = [&](int cell) { return ((cell - 1) >> cells_log2) + 1; };
    return {begin(cells.x_begin), begin(cells.y_begin), end(cells.x_end), end(cells.y_end)};
  }
};

/// Of a bin of 4 x 4 cells the parts, which are its cells, that lie in `cells`.
Parts parts_in(const CellRectangle& cells, int column, int row);

/// Which parts of such bins something may touch: those in a rectangle of cells and, where that has
/// so many that an outline leaves some of them out, in its outline.
template <typename Outline>
class TouchedParts {
 public:
  /// make_outline() gives its PartOutline.
  template <typename MakeOutline>
  TouchedParts(const CellRectangle& cells, const MakeOutline& make_outline) : cells_(cells) {
    constexpr int few = 3;
    if (cells.x_end - cells.x_begin > few && cells.y_end - cells.y_begin > few)
      outline_.emplace(make_outline());
  }

  /// Of the bin at (column, row), which begins at (x, y) as the outline counts.
  Parts of_bin(int column, int row, double x, double y) const {
    const Parts in_rectangle = parts_in(cells_, column, row);
    return outline_ ? in_rectangle & outline_->parts_reached(x, y) : in_rectangle;
  }

 private:
  CellRectangle cells_;
  std::optional<Outline> outline_;
};
template <typename MakeOutline>
TouchedParts(const CellRectangle&, const MakeOutline&)
    -> TouchedParts<std::invoke_result_t<MakeOutline>>;

/// An item on its way to its bins.
template <typename Entry>
struct Placed {
  CellRectangle cells;  ///< if empty, the item comes into no bin
  Entry entry;          ///< the same for all its bins
};

namespace binning {

/// What a chunk of the items puts into each band, in the items' order: in blocks, because how much
/// it will be is not known before.
template <typename Entry>
class ChunkRecords {
 public:
  ChunkRecords() = default;
  /// Of so many items, each of which comes into a band once at most.
  ChunkRecords(std::size_t band_count, std::size_t item_count)
      : bands_(band_count),
        block_size_(std::min(item_count, most_in_block)),
        slab_size_(std::clamp(item_count, band_count * block_size_, most_in_slab)) {}

  void add(std::size_t band, const Placed<Entry>& record, std::size_t entry_count) {
    Band& to = bands_[band];
    if (to.next == to.end) begin_block(to);
    to.entry_count += entry_count;
    *to.next++ = record;
  }

  /// Of all the band's records.
  std::size_t entry_count(std::size_t band) const { return bands_[band].entry_count; }

  template <typename Visit>
  void for_each(std::size_t band, const Visit& visit) const {
    for (const Placed<Entry>* const block : bands_[band].blocks) {
      const bool is_last = block == bands_[band].blocks.back();
      const Placed<Entry>* const end = is_last ? bands_[band].next : block + block_size_;
      for (const Placed<Entry>* record = block; record != end; ++record) visit(*record);
    }
  }

 private:
  static constexpr std::size_t most_in_block = 512;
  static constexpr std::size_t most_in_slab = 1 << 16;

  struct Band {
    Placed<Entry>* next = nullptr;  ///< in the last block
    Placed<Entry>* end = nullptr;   ///< of the last block
    std::size_t entry_count = 0;
    std::vector<Placed<Entry>*> blocks;
  };

  void begin_block(Band& band) {
    if (slabs_.empty() || used_ + block_size_ > slab_size_) {
      slabs_.emplace_back(slab_size_);
      used_ = 0;
    }
    band.next = slabs_.back().data() + used_;
    band.end = band.next + block_size_;
    band.blocks.push_back(band.next);
    used_ += block_size_;
  }

  std::vector<Band> bands_;
  std::size_t block_size_ = 0;  ///< in records
  std::size_t slab_size_ = 0;   ///< likewise
  std::size_t used_ = 0;        ///< of the last slab
  std::vector<LargeArray<Placed<Entry>>> slabs_;
};

/// The rows of a grid, cut into at most `most_bands` bands of 2^k rows.
class Bands {
 public:
  Bands(const BinGrid& grid, int most_bands) : grid_(grid) {
    while (((grid.rows - 1) >> height_log2_) >= most_bands) ++height_log2_;
  }

  std::size_t count() const {
    return static_cast<std::size_t>((grid_.rows - 1) >> height_log2_) + 1;
  }
  const BinGrid& grid() const { return grid_; }
  int row_begin(std::size_t band) const { return static_cast<int>(band) << height_log2_; }
  int row_end(std::size_t band) const { return std::min(row_begin(band + 1), grid_.rows); }

  /// Of the bins that cells touch those that are in the band.
  CellRectangle bins_of(const CellRectangle& cells, std::size_t band) const {
    return part_in(grid_.bins_of(cells), band);
  }
  /// Those of `bins` that are in the band.
  CellRectangle part_in(CellRectangle bins, std::size_t band) const {
    bins.y_begin = std::max(bins.y_begin, row_begin(band));
    bins.y_end = std::min(bins.y_end, row_end(band));
    return bins;
  }

  std::size_t of_row(int row) const { return static_cast<std::size_t>(row >> height_log2_); }

 private:
  BinGrid grid_;
  int height_log2_ = 0;
};

/// What a part of the items puts into each band, as place(item) says.
template <typename Entry, typename Place>
ChunkRecords<Entry> records_of(std::size_t begin, std::size_t end, const Bands& bands,
                               const Place& place) {
  ChunkRecords<Entry> records(bands.count(), end - begin);
  const Place own_place = place;  // own copies: what they hold stays in registers
  const Bands to = bands;
  const BinGrid bins = bands.grid();
  for (std::size_t item = begin; item < end; ++item) {
    const Placed<Entry> record = own_place(item);
    if (record.cells.empty()) continue;
    const CellRectangle touched = bins.bins_of(record.cells);
    const std::size_t last_band = to.of_row(touched.y_end - 1);
    for (std::size_t band = to.of_row(touched.y_begin); band <= last_band; ++band)
      records.add(band, record, to.part_in(touched, band).cell_count());
  }
  return records;
}

/// How many entries come before each band, and in all.
template <typename Entry>
std::vector<std::size_t> begins_of_bands(const std::vector<ChunkRecords<Entry>>& chunks,
                                         const Bands& bands) {
  std::vector<std::size_t> begins(bands.count() + 1);
  for (std::size_t band = 0; band < bands.count(); ++band) {
    begins[band + 1] = begins[band];
    for (const auto& chunk : chunks) begins[band + 1] += chunk.entry_count(band);
  }
  if (begins.back() > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("more entries in bins than 32 bits count");
  return begins;
}

/// Calls visit(record, its bins in the band) for all of a band's records, in the items' order.
template <typename Entry, typename Visit>
void for_each_record(const std::vector<ChunkRecords<Entry>>& chunks, const Bands& bands,
                     std::size_t band, const Visit& visit) {
  for (const auto& chunk : chunks)
    chunk.for_each(band, [&](const Placed<Entry>& record) {
      visit(record, bands.bins_of(record.cells, band));
    });
}

/// Where the entries of each of a band's bins begin in the band, and the end of the last.
template <typename Entry>
std::vector<std::uint32_t> begins_in_band(const std::vector<ChunkRecords<Entry>>& chunks,
                                          const Bands& bands, std::size_t band) {
  const BinGrid grid = bands.grid();
  const std::size_t first_bin = grid.index(0, bands.row_begin(band));
  const std::size_t last_bin = grid.index(0, bands.row_end(band));
  std::vector<std::uint32_t> begins(last_bin - first_bin + 1, 0);
  for_each_record(chunks, bands, band, [&](const Placed<Entry>&, const CellRectangle& bins) {
    for (int row = bins.y_begin; row < bins.y_end; ++row)
      for (int column = bins.x_begin; column < bins.x_end; ++column)
        ++begins[grid.index(column, row) - first_bin + 1];
  });
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
  return begins;
}

/// The band's entries, bin by bin: begins[i] becomes the end of its bin i.
template <typename Entry, typename EntriesOf>
LargeArray<Entry> entries_of_band(const std::vector<ChunkRecords<Entry>>& chunks,
                                  const Bands& bands, std::size_t band, const EntriesOf& entries_of,
                                  std::vector<std::uint32_t>& begins) {
  const BinGrid grid = bands.grid();
  const std::size_t first_bin = grid.index(0, bands.row_begin(band));
  LargeArray<Entry> entries(begins.back());
  for_each_record(chunks, bands, band, [&](const Placed<Entry>& record, const CellRectangle& bins) {
    const auto entry_in = entries_of(record.entry, record.cells);
    for (int row = bins.y_begin; row < bins.y_end; ++row)
      for (int column = bins.x_begin; column < bins.x_end; ++column)
        entries[begins[grid.index(column, row) - first_bin]++] = entry_in(column, row);
  });
  return entries;
}

}  // namespace binning

/// Sorts `item_count` items into bins, row by row, as these say, from several threads:
///
///   place(item) -> Placed<Entry>
///   entries_of(Entry, its cells) -> what gives its entry in a bin: (column, row) -> Entry
///   arrange(span of a bin's entries, in the items' order): puts them into order
///
/// Calls resize(entry_count) once, then from several threads write(first, entries) for all entries
/// of each bin that has some, of which `first` come in bins before it.
/// Returns where each bin's entries begin, and the end of the last.
template <typename Entry, typename Place, typename EntriesOf, typename Arrange, typename Resize,
          typename Write>
std::vector<std::uint32_t> sort_into_bins(std::size_t item_count, const BinGrid& grid,
                                          WorkerPool& pool, const Place& place,
                                          const EntriesOf& entries_of, const Arrange& arrange,
                                          const Resize& resize, const Write& write) {
  constexpr std::size_t few_bins = 1024;  // their counts are in the first cache
  constexpr int most_bands = 64;          // each is one task of a thread
  const std::size_t chunk_count = item_count < few_items ? 1 : pool.thread_count();
  const binning::Bands bands(grid,
                             chunk_count == 1 && grid.bin_count() <= few_bins ? 1 : most_bands);
  std::vector<binning::ChunkRecords<Entry>> chunks(chunk_count);
  for_each_chunk(item_count, chunk_count, pool,
                 [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                   chunks[chunk] = binning::records_of<Entry>(begin, end, bands, place);
                 });

  const std::vector<std::size_t> band_begins = binning::begins_of_bands(chunks, bands);
  std::vector<std::uint32_t> bin_begins(grid.bin_count() + 1);
  bin_begins[grid.bin_count()] = static_cast<std::uint32_t>(band_begins.back());
  resize(band_begins.back());
  const auto sort_band = [&](std::size_t band) {
    const auto band_begin = static_cast<std::uint32_t>(band_begins[band]);
    std::vector<std::uint32_t> bounds = binning::begins_in_band(chunks, bands, band);
    std::uint32_t* const begins = &bin_begins[grid.index(0, bands.row_begin(band))];
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) begins[i] = band_begin + bounds[i];
    LargeArray<Entry> entries = binning::entries_of_band(chunks, bands, band, entries_of, bounds);
    // Now bounds[i] is the end of the band's bin i.
    std::uint32_t begin = 0;
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
      if (bounds[i] == begin) continue;
      const std::span<Entry> bin = std::span(entries).subspan(begin, bounds[i] - begin);
      arrange(bin);
      write(band_begin + begin, std::span<const Entry>(bin));
      begin = bounds[i];
    }
  };
  for_each_chunk(bands.count(), chunk_count == 1 ? 1 : bands.count(), pool,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   for (std::size_t band = begin; band < end; ++band) sort_band(band);
                 });
  return bin_begins;
}

}  // namespace raytracer
