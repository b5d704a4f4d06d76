#include "vtu_file.hpp"

#include <zlib.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace real_test {

namespace {

constexpr std::uint8_t tetrahedron = 10;

[[noreturn]] void refuse(const std::string &what) { throw std::runtime_error(what); }

class VtuFile {
 public:
  explicit VtuFile(const std::string &path) : path_(path) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
    const std::size_t appended = bytes_.find("<AppendedData encoding=\"raw\">");
    if (bytes_.find("compressor=\"vtkZLibDataCompressor\"") > appended ||
        bytes_.find("header_type=\"UInt32\"") > appended || bytes_.find("byte_order=\"LittleEndian\"") > appended)
      refuse(path + " is not written as the data sets are");
    header_ = bytes_.substr(0, appended);
    data_ = bytes_.find('_', appended) + 1;
  }

  std::size_t count(const std::string &attribute) const { return std::stoul(attribute_after(0, attribute)); }

  template <class T>
  std::vector<T> array(const std::string &name, const std::string &type, std::size_t expected) const {
    const std::size_t at = header_.find("type=\"" + type + "\" Name=\"" + name + "\"");
    if (at == std::string::npos) refuse(path_ + " has no array " + name + " of " + type);
    const std::string content = inflated(data_ + std::stoul(attribute_after(at, "offset")));
    if (content.size() != expected * sizeof(T)) refuse(path_ + ": array " + name + " has another size than it should");
    std::vector<T> values(expected);
    std::memcpy(values.data(), content.data(), content.size());
    return values;
  }

 private:
  std::string attribute_after(std::size_t at, const std::string &name) const {
    const std::size_t found = header_.find(" " + name + "=\"", at);
    if (found == std::string::npos) refuse(path_ + " has no attribute " + name);
    const std::size_t begin = found + name.size() + 3;
    return header_.substr(begin, header_.find('"', begin) - begin);
  }

  std::uint32_t number(std::size_t at) const {
    if (at + 4 > bytes_.size()) refuse(path_ + " is cut short");
    std::uint32_t value;
    std::memcpy(&value, bytes_.data() + at, sizeof value);
    return value;
  }

  /// Before the data: how many blocks, the size of each, the size of the last if it is less, then the compressed sizes.
  std::string inflated(std::size_t at) const {
    const std::size_t blocks = number(at), size = number(at + 4), last = number(at + 8);
    std::size_t from = at + 12 + 4 * blocks;
    std::string content;
    for (std::size_t b = 0; b < blocks; b++) {
      const std::size_t packed = number(at + 12 + 4 * b);
      std::string block(b + 1 == blocks && last ? last : size, '\0');
      uLongf length = block.size();
      if (from + packed > bytes_.size() ||
          uncompress(reinterpret_cast<Bytef *>(block.data()), &length,
                     reinterpret_cast<const Bytef *>(bytes_.data() + from), packed) != Z_OK ||
          length != block.size())
        refuse(path_ + " has a block that zlib does not read");
      content += block;
      from += packed;
    }
    return content;
  }

  std::string path_, bytes_, header_;
  std::size_t data_ = 0;
};

}  // namespace

TetFile read_vtu(const std::string &path) {
  const VtuFile file(path);
  const std::size_t points = file.count("NumberOfPoints"), tets = file.count("NumberOfCells");
  for (std::uint8_t type : file.array<std::uint8_t>("types", "UInt8", tets))
    if (type != tetrahedron) refuse(path + " has cells that are no tets");
  TetFile mesh;
  mesh.scalars = file.array<double>("scalar", "Float64", points);
  const std::vector<double> xyz = file.array<double>("Points", "Float64", 3 * points);
  for (std::size_t i = 0; i < points; i++) mesh.points.push_back({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
  const auto corners = file.array<std::int64_t>("connectivity", "Int64", 4 * tets);
  for (std::size_t t = 0; t < tets; t++) {
    Tet tet;
    for (std::size_t k = 0; k < 4; k++) tet[k] = std::int32_t(corners[4 * t + k]);
    mesh.tets.push_back(tet);
  }
  return mesh;
}

}  // namespace real_test
