// Compressed files: unpacked as they are read, whole or refused.
#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

#include <string>
#include <vector>

#include "client/failure.h"
#include "client/formats/format.h"
#include "client/formats/text_source.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

std::string gzipped(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

std::string zstandard(const std::string& text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 3));
  return packed;
}

class Compressed : public testing::Test {
 protected:
  std::string read(const std::string& name, const std::string& bytes) const {
    return client::read_all(*client::source_of_file(folder_.write(name, bytes).string()));
  }

  /// What reading it throws.
  std::string error(const std::string& name, const std::string& bytes) const {
    try {
      read(name, bytes);
    } catch (const client::InputError& refusal) {
      return refusal.what();
    }
    return {};
  }

  const TemporaryFolder folder_;
  const std::string text_ = [] {
    std::string text;
    for (int i = 0; i < 100'000; ++i) text += std::to_string(i % 1009 * 7 % 997) + "\n";
    return text;
  }();
};

TEST_F(Compressed, is_read_as_it_was) {
  EXPECT_EQ(read("a.xyz.gz", gzipped(text_)), text_);
  EXPECT_EQ(read("a.xyz.zst", zstandard(text_)), text_);
  EXPECT_EQ(read("a.xyz", text_), text_);
}

TEST_F(Compressed, members_follow_each_other) {
  EXPECT_EQ(read("a.csv.gz", gzipped(text_) + gzipped("end")), text_ + "end");
  EXPECT_EQ(read("a.csv.ZST", zstandard(text_) + zstandard("end")), text_ + "end");
}

TEST_F(Compressed, zeros_that_fill_up_the_last_block_are_no_member) {
  EXPECT_EQ(read("a.csv.gz", gzipped(text_) + std::string(1000, '\0')), text_);
}

TEST_F(Compressed, that_is_cut_off_or_damaged_is_refused) {
  for (const auto& [name, packed] : {std::pair{std::string("a.gz"), gzipped(text_)},
                                     std::pair{std::string("a.zst"), zstandard(text_)}}) {
    EXPECT_NE(error(name, packed.substr(0, packed.size() / 2)).find("ends early"),
              std::string::npos);
    std::string damaged = packed;
    for (std::size_t i = packed.size() / 2; i < packed.size(); ++i) damaged[i] = '\x55';
    EXPECT_NE(error(name, damaged), "");
    EXPECT_NE(error(name, text_).find("is damaged"), std::string::npos);
  }
}

TEST_F(Compressed, bomb_is_refused_before_it_is_unpacked) {
  const std::string nothing(std::size_t{200} << 20, '\0');
  EXPECT_NE(error("a.xyz.gz", gzipped(nothing)).find("more than a hundred times"),
            std::string::npos);
  EXPECT_NE(error("a.xyz.zst", zstandard(nothing)).find("more than a hundred times"),
            std::string::npos);
}

TEST_F(Compressed, ending_of_the_format_stands_before) {
  EXPECT_EQ(client::format_of("a/b.PDB.gz"), client::format_of("c.pdb"));
  EXPECT_EQ(client::format_of("b.nff.zst"), client::format_of("c.nff"));
  EXPECT_EQ(client::format_of("dump.melt.gz"), client::format_of("c.dump"));
}

}  // namespace
}  // namespace raytracer::test
