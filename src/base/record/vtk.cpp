#include "record/vtk.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>

#include "record/escaped_text.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

constexpr std::size_t kZippedBlock = 1 << 16;  // bytes
constexpr int kLevel = 3;                      // half of zlib's best compression for a fifth of its time on our arrays
constexpr std::uint8_t kHexahedron = 12;

template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, float>)
    return "Float32";
  else if constexpr (std::is_same_v<T, double>)
    return "Float64";
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return "Int32";
  else if constexpr (std::is_same_v<T, std::int64_t>)
    return "Int64";
  else
    return "UInt8";
}

template <class T>
void append_bytes(std::string& out, const T* data, std::size_t count) {
  out.append(reinterpret_cast<const char*>(data), count * sizeof(T));
}

/// Header {blocks, block size, size of a last part block, compressed sizes…}, then the blocks.
void append_compressed(std::string& out, std::string_view raw) {
  std::vector<std::uint64_t> header = {(raw.size() + kZippedBlock - 1) / kZippedBlock, kZippedBlock,
                                       raw.size() % kZippedBlock};
  std::string blocks, buffer(compressBound(kZippedBlock), '\0');
  for (std::size_t begin = 0; begin < raw.size(); begin += kZippedBlock) {
    const std::string_view block = raw.substr(begin, kZippedBlock);
    uLongf size = buffer.size();
    if (compress2(reinterpret_cast<Bytef*>(buffer.data()), &size, reinterpret_cast<const Bytef*>(block.data()),
                  block.size(), kLevel) != Z_OK)
      throw std::bad_alloc();
    header.push_back(size);
    blocks.append(buffer.data(), size);
  }
  append_bytes(out, header.data(), header.size());
  out += blocks;
}

/// The XML text and, growing beside it, the appended data it points to.
class Document {
 public:
  explicit Document(const char* type)
      : xml_(fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"{1}\" "
                         "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<{0}>\n",
                         type, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")) {}
  void line(std::string_view text) {
    xml_ += text;
    xml_ += '\n';
  }
  template <class T>
  void array(const std::string& name, int components, std::span<const T> values,
             const std::vector<std::string>& component_names = {}) {
    std::string labels;
    for (std::size_t i = 0; i < component_names.size(); ++i)
      labels += fmt::format(" ComponentName{}=\"{}\"", i, component_names[i]);
    line(fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"appended\" offset=\"{}\"/>",
        type_name<T>(), name, components, labels, appended_.size()));
    append_compressed(appended_, {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  std::string finished(const char* type) {
    xml_ += fmt::format("</{}>\n<AppendedData encoding=\"raw\">\n_", type);
    xml_ += appended_;
    xml_ += "\n</AppendedData>\n</VTKFile>\n";  // meshio needs the newline
    return std::move(xml_);
  }

 private:
  std::string xml_, appended_;
};

bool plain(const std::string& name) {
  constexpr const char* kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.";
  return !name.empty() && name.find_first_not_of(kPlain) == std::string::npos;
}

std::vector<std::string> component_names(const VtkField& field) {
  if (field.components == 3) return {"X", "Y", "Z"};
  if (field.components == 6) return {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  return {};
}

void add_fields(Document& document, const char* section, const std::vector<VtkField>& fields, std::size_t count) {
  document.line(fmt::format("<{}>", section));
  for (const VtkField& field : fields) {
    const std::vector<std::string> labels = component_names(field);
    if (!plain(field.name))
      throw std::invalid_argument("VTK array name '" + field.name + "': letters, digits and _ - . only");
    std::visit(
        [&](const auto& values) {
          using T = typename std::decay_t<decltype(values)>::value_type;
          if (field.components < 1 || values.size() != count * static_cast<std::size_t>(field.components))
            throw std::invalid_argument(fmt::format("VTK array '{}' has {} values for {} x {}", field.name,
                                                    values.size(), count, field.components));
          document.array<T>(field.name, field.components, values, labels);
        },
        field.values);
  }
  document.line(fmt::format("</{}>", section));
}

void add_points(Document& document, const std::vector<Vec3>& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  document.line("<Points>");
  document.array<double>("Points", 3, {reinterpret_cast<const double*>(points.data()), 3 * points.size()});
  document.line("</Points>");
}

template <std::size_t Corners>
void add_cells(Document& document, const VtkMesh<Corners>& mesh) {
  std::vector<std::int64_t> connectivity, offsets;
  for (const auto& cell : mesh.cells) {
    for (const long long node : cell) {
      if (node < 0 || node >= static_cast<long long>(mesh.points.size()))
        throw std::invalid_argument("a VTK cell refers to a point that does not exist");
      connectivity.push_back(node);
    }
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  document.array<std::int64_t>("connectivity", 1, connectivity);
  document.array<std::int64_t>("offsets", 1, offsets);
}

/// All before the cells; piece: their numbers.
template <std::size_t Corners>
void add_data(Document& document, const VtkMesh<Corners>& mesh, std::string_view piece) {
  document.line(fmt::format("<Piece NumberOfPoints=\"{}\" {}=\"{}\">", mesh.points.size(), piece, mesh.cells.size()));
  add_fields(document, "PointData", mesh.point_fields, mesh.points.size());
  add_fields(document, "CellData", mesh.cell_fields, mesh.cells.size());
  add_points(document, mesh.points);
}

}  // namespace

void write_vtu(const std::filesystem::path& file, const VtkHexahedra& mesh) {
  Document document("UnstructuredGrid");
  add_data(document, mesh, "NumberOfCells");
  document.line("<Cells>");
  add_cells(document, mesh);
  const std::vector<std::uint8_t> types(mesh.cells.size(), kHexahedron);
  document.array<std::uint8_t>("types", 1, types);
  document.line("</Cells>\n</Piece>");
  write_whole_file(file, document.finished("UnstructuredGrid"));
}

void write_vtp(const std::filesystem::path& file, const VtkQuads& mesh) {
  Document document("PolyData");
  add_data(document, mesh, "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys");
  document.line("<Polys>");
  add_cells(document, mesh);
  document.line("</Polys>\n</Piece>");
  write_whole_file(file, document.finished("PolyData"));
}

void PvdSeries::add(double time, const std::filesystem::path& frame) {
  const std::string relative = std::filesystem::absolute(frame)
                                   .lexically_proximate(std::filesystem::absolute(file_).parent_path())
                                   .generic_string();
  entries_ +=
      fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", time, markup_text(relative));
  write_whole_file(file_, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" +
                              entries_ + "</Collection>\n</VTKFile>\n");
}

}  // namespace railstrata
