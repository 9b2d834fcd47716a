#include "vessel/image/image_file.hpp"

#define ITK_IO_FACTORY_REGISTER_MANAGER_NONE
#include <itkCastImageFilter.h>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkImageFileWriter.h>
#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkVectorImage.h>

#include <Eigen/LU>
#include <cmath>
#include <fstream>

#include "common/base/error.hpp"
#include "vessel/image/image_check.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Grey = itk::Image<float, 3>;

bool ends_with(const fs::path& file, std::initializer_list<const char*> endings) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::any_of(endings.begin(), endings.end(), [&](const char* e) { return name.ends_with(e); });
}

itk::ImageIOBase::Pointer format_of(const fs::path& file) {
  if (ends_with(file, {".mha", ".mhd"})) return itk::MetaImageIO::New().GetPointer();
  if (ends_with(file, {".nrrd", ".nhdr"})) return itk::NrrdImageIO::New().GetPointer();
  if (ends_with(file, {".nii", ".nii.gz"})) return itk::NiftiImageIO::New().GetPointer();
  throw input_error("{}: an image is .mha, .mhd, .nrrd, .nhdr, .nii or .nii.gz{}", file.string(),
                    fs::is_directory(file) || ends_with(file, {".dcm", ".ima"})
                        ? "; a DICOM series becomes one by 3D Slicer or dcm2niix"
                        : "");
}

/// What ITK says of a failure, without its own sources' names; of teem's "[nrrd] function: words", each the cause of
/// the one before, the last words.
std::string reason(const itk::ExceptionObject& error) {
  std::string text = error.GetDescription();
  const bool begins_with_source = text.starts_with("ITK ERROR") || text.starts_with("itk::ERROR");
  if (const auto end = text.find("): "); begins_with_source && end != std::string::npos) text.erase(0, end + 3);
  if (const auto cause = text.rfind("[nrrd] "); cause != std::string::npos)
    text.erase(0, std::min(text.find(": ", cause), text.size() - 2) + 2);
  text.erase(text.find_last_not_of(" \n") + 1);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// A segment of a .seg.nrrd, as 3D Slicer writes them: those that overlap lie in different layers.
struct Segment {
  std::string name;
  unsigned layer = 0;
  float value = 1;
};

std::vector<Segment> segments_of(const itk::ImageIOBase& io) {
  const auto entry = [&](std::size_t number, const char* key) {
    std::string text;
    itk::ExposeMetaData(io.GetMetaDataDictionary(), fmt::format("Segment{}_{}", number, key), text);
    return text;
  };
  const auto number = [](const std::string& text, unsigned long otherwise) {
    return text.empty() || !std::isdigit(static_cast<unsigned char>(text[0])) ? otherwise : std::stoul(text);
  };
  std::vector<Segment> segments;
  for (std::string id; !(id = entry(segments.size(), "ID")).empty();) {
    const std::string name = entry(segments.size(), "Name");
    segments.push_back({name.empty() ? id : name, static_cast<unsigned>(number(entry(segments.size(), "Layer"), 0)),
                        static_cast<float>(number(entry(segments.size(), "LabelValue"), 1))});
  }
  return segments;
}

std::string listed(const std::vector<Segment>& segments) {
  std::string text;
  for (const Segment& segment : segments) text += (text.empty() ? "" : ", ") + segment.name;
  return text;
}

/// Throws InputError for the one space that ITK 5.2 reads mirrored: x turned instead of y.
void check_space(const fs::path& file) {
  if (!ends_with(file, {".nrrd", ".nhdr"})) return;
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line) && !line.empty() && line != "\r";)
    if (line.starts_with("space: left-anterior-superior") || line.starts_with("space: LAS"))
      throw input_error("{}: its space is left-anterior-superior, which would be read mirrored: save it as LPS or RAS",
                        file.string());
}

/// Throws InputError unless the header is that of a volume.
void check_volume(const std::string& name, const itk::ImageIOBase& io) {
  const auto size = [&](unsigned axis) { return axis < io.GetNumberOfDimensions() ? io.GetDimensions(axis) : 1; };
  if (io.GetNumberOfDimensions() < 3 || size(0) < 2 || size(1) < 2 || size(2) < 2)
    throw input_error("{}: is not a volume: {} x {} x {} voxels", name, size(0), size(1), size(2));
  for (unsigned axis = 3; axis < io.GetNumberOfDimensions(); ++axis)
    if (size(axis) > 1)
      throw input_error("{}: has {} dimensions, {} images in a row: give one of them", name, io.GetNumberOfDimensions(),
                        size(axis));
}

/// Throws InputError unless there is one value a voxel.
void check_one_value(const std::string& name, const itk::ImageIOBase& io) {
  if (io.GetNumberOfComponents() == 1) return;
  if (const std::vector<Segment> segments = segments_of(io); !segments.empty())
    throw input_error("{}: its segments overlap: say by name which are meant, labels: [{}]", name, listed(segments));
  throw input_error("{}: has {} values a voxel ({}): grey values or labels are wanted, one a voxel", name,
                    io.GetNumberOfComponents(), itk::ImageIOBase::GetPixelTypeAsString(io.GetPixelType()));
}

/// The header's geometry, lengths in cm.
ImageVolume geometry_of(const itk::ImageBase<3>& from, const std::string& name, double cm) {
  ImageVolume image;
  image.name = name;
  const auto size = from.GetLargestPossibleRegion().GetSize();
  for (unsigned axis = 0; axis < 3; ++axis) {
    image.count[axis] = static_cast<int>(size[axis]);
    image.origin[axis] = cm * from.GetOrigin()[axis], image.spacing[axis] = cm * from.GetSpacing()[axis];
    for (unsigned row = 0; row < 3; ++row) image.axes(row, axis) = from.GetDirection()(row, axis);
  }
  if (!(image.spacing.minCoeff() > 0) || !image.spacing.allFinite() || !image.origin.allFinite())
    throw input_error("{}: the header's spacing or origin is no length", name);
  if (!(image.axes.transpose() * image.axes).isIdentity(1e-3))
    throw input_error("{}: the header's axes are not at right angles (a tilted gantry?): resample the image", name);
  return image;
}

void check_finite(const ImageVolume& image) {
  std::size_t count = 0, first = 0;
  for (std::size_t i = 0; i < image.values.size(); ++i)
    if (!std::isfinite(image.values[i]) && ++count == 1) first = i;
  if (count == 0) return;
  const auto [i, j, k] = image.voxel(first);
  throw input_error("{}: {} voxels have values that are not finite, the first is voxel {} {} {} (from 0)", image.name,
                    count, i, j, k);
}

/// The segments of these names.
std::vector<Segment> asked_of(const std::vector<Segment>& segments, const std::vector<std::string>& names,
                              const std::string& file, const std::string& field) {
  if (segments.empty())
    throw input_error("{}: {}: {} names no segments as a .seg.nrrd does: give the labels' numbers", field,
                      names.front(), file);
  std::vector<Segment> asked;
  for (const std::string& name : names) {
    const auto found = std::find_if(segments.begin(), segments.end(), [&](const Segment& s) { return s.name == name; });
    if (found == segments.end())
      throw input_error("{}: {}: is not a segment of {}, which has {}", field, name, file, listed(segments));
    asked.push_back(*found);
  }
  return asked;
}

template <class Image>
typename Image::Pointer read_as(const fs::path& file, itk::ImageIOBase& io) {
  const auto reader = itk::ImageFileReader<Image>::New();
  reader->SetImageIO(&io);
  reader->SetFileName(file.string());
  reader->Update();
  return reader->GetOutput();
}

/// What `read` makes of a file whose header and length are right; a failure of ITK as an InputError.
template <class Read>
ImageVolume guarded(const fs::path& file, Read read) {
  const auto io = format_of(file);
  const std::string name = file.string();
  check_image(file);
  try {
    io->SetFileName(name);
    if (!io->CanReadFile(name.c_str())) throw input_error("{}: is not an image of the kind that its ending says", name);
    io->ReadImageInformation();
    check_volume(name, *io);
    check_space(file);
    return read(*io);
  } catch (const itk::ExceptionObject& error) {
    throw input_error("{}: cannot be read: {}", name, reason(error));
  }
}

template <class Voxel>
void write_as(const fs::path& file, const Grey& image) {
  using Out = itk::Image<Voxel, 3>;
  const auto cast = itk::CastImageFilter<Grey, Out>::New();
  cast->SetInput(&image);
  const auto writer = itk::ImageFileWriter<Out>::New();
  writer->SetImageIO(format_of(file));
  writer->SetFileName(file.string());
  writer->SetInput(cast->GetOutput());
  writer->UseCompressionOn();
  writer->Update();
}

}  // namespace

ImageVolume read_image(const fs::path& file, double cm) {
  return guarded(file, [&](itk::ImageIOBase& io) {
    check_one_value(file.string(), io);
    const auto grey = read_as<Grey>(file, io);
    ImageVolume image = geometry_of(*grey, file.string(), cm);
    const float* first = grey->GetBufferPointer();
    image.values.assign(first, first + grey->GetLargestPossibleRegion().GetNumberOfPixels());
    check_finite(image);
    return image;
  });
}

ImageVolume read_segments(const fs::path& file, double cm, const std::vector<std::string>& names,
                          const std::string& field) {
  return guarded(file, [&](itk::ImageIOBase& io) {
    const std::vector<Segment> asked = asked_of(segments_of(io), names, file.string(), field);
    const auto layers = read_as<itk::VectorImage<float, 3>>(file, io);
    ImageVolume image = geometry_of(*layers, file.string(), cm);
    const float* voxel = layers->GetBufferPointer();
    const unsigned count = layers->GetNumberOfComponentsPerPixel();
    image.values.resize(layers->GetLargestPossibleRegion().GetNumberOfPixels());
    for (float& value : image.values) {
      value = std::any_of(asked.begin(), asked.end(),
                          [&](const Segment& s) { return s.layer < count && voxel[s.layer] == s.value; });
      voxel += count;
    }
    return image;
  });
}

void write_image(const fs::path& file, const ImageVolume& image, bool whole) {
  constexpr double mm = 10;
  const auto grey = Grey::New();
  Grey::SizeType size;
  Grey::PointType origin;
  Grey::SpacingType spacing;
  Grey::DirectionType axes;
  for (unsigned axis = 0; axis < 3; ++axis) {
    size[axis] = static_cast<itk::SizeValueType>(image.count[axis]);
    origin[axis] = mm * image.origin[axis], spacing[axis] = mm * image.spacing[axis];
    for (unsigned row = 0; row < 3; ++row) axes(row, axis) = image.axes(row, axis);
  }
  grey->SetRegions(size);
  grey->SetOrigin(origin), grey->SetSpacing(spacing), grey->SetDirection(axes);
  grey->Allocate();
  std::transform(image.values.begin(), image.values.end(), grey->GetBufferPointer(),
                 [whole](float value) { return whole ? std::round(value) : value; });
  try {
    whole ? write_as<std::int16_t>(file, *grey) : write_as<float>(file, *grey);
  } catch (const itk::ExceptionObject& error) {
    throw run_error("{}: cannot be written: {}", file.string(), reason(error));
  }
}

}  // namespace tether
