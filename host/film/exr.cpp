#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/film/codec.h"
#include "host/film/exr_header.h"

namespace duolux {

namespace {

using ChannelNames = std::vector<std::string>;

/// The channels of a layer: "normal.X" ... The layer without a name is the displayed image.
ChannelNames channelsOf(const std::string& layer, std::string_view channels = "RGB") {
    ChannelNames names;
    for (const char channel : channels)
        names.push_back((layer.empty() ? "" : layer + ".") + channel);
    return names;
}

/// Output stream for OpenEXR. OpenEXR completes the file in a destructor and drops exceptions there, so the
/// stream keeps the first exception.
class ExrOutput : public Imf::OStream {
  public:
    explicit ExrOutput(FileWriter& out) : Imf::OStream("output"), out_(out) {}
    void write(const char* source, int count) override {
        attempt([&] { out_.write({source, static_cast<std::size_t>(count)}); });
    }
    std::uint64_t tellp() override { return out_.position(); }
    void seekp(std::uint64_t position) override {
        attempt([&] { out_.seek(position); });
    }
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

  private:
    template <typename Step>
    void attempt(const Step& step) {
        try {
            step();
        } catch (...) {
            if (!failure_) failure_ = std::current_exception();
            throw;
        }
    }

    FileWriter& out_;
    std::exception_ptr failure_;
};

class MemoryInput : public Imf::IStream {
  public:
    explicit MemoryInput(std::string_view bytes) : Imf::IStream("memory"), bytes_(bytes) {}
    bool read(char* target, int count) override {
        const auto wanted = static_cast<std::size_t>(count);
        if (position_ > bytes_.size() || wanted > bytes_.size() - position_) {
            throw Iex::InputExc("unexpected end of file");
        }
        std::memcpy(target, bytes_.data() + position_, wanted);
        position_ += wanted;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    std::string_view bytes_;
    std::size_t position_ = 0;
};

/// Adds float channels stored one after the other for each pixel. `origin` is the address that the pixel (0,
/// 0) would have.
void addSlices(Imf::FrameBuffer& frame, const ChannelNames& names, const float* origin, std::size_t width) {
    // OpenEXR's slices take non-const pointers even for writing a file, which only reads the memory.
    char* base = const_cast<char*>(reinterpret_cast<const char*>(origin));
    const std::size_t pixelBytes = names.size() * sizeof(float);
    for (std::size_t c = 0; c < names.size(); ++c)
        frame.insert(names[c],
                     Imf::Slice(Imf::FLOAT, base + c * sizeof(float), pixelBytes, width * pixelBytes));
}

const float* floatsOf(const glm::vec3* pixels) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    return reinterpret_cast<const float*>(pixels);
}

bool hasChannels(const Imf::ChannelList& channels, const ChannelNames& names) {
    return std::ranges::all_of(
        names, [&](const std::string& name) { return channels.findChannel(name) != nullptr; });
}

}  // namespace

void encodeExr(const ImageRows& rows, const ImageOptions& options, FileWriter& out) {
    Imf::Header header(static_cast<int>(rows.width), static_cast<int>(rows.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [key, value] : options.metadata)
        header.insert(key, Imf::StringAttribute(value));
    const ChannelNames displayed = channelsOf(""), invisible = channelsOf("invisible"),
                       visible = channelsOf("visible");
    const auto declare = [&](const ChannelNames& names) {
        for (const std::string& name : names)
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    };
    for (const ChannelNames& names : {displayed, invisible, visible})
        declare(names);
    for (const LayerRows& layer : rows.layers)
        declare(channelsOf(layer.name, layer.channels));
    RowBand band(rows, options.display);
    std::vector<std::vector<float>> layers(rows.layers.size());  // the same rows of each
    ExrOutput output(out);
    try {
        Imf::OutputFile file(output, header);
        for (std::uint32_t y = 0; y < rows.height; y += RowBand::kRows) {
            const std::uint32_t count = band.read(y);
            const std::size_t before = std::size_t{y} * rows.width;
            Imf::FrameBuffer frame;
            addSlices(frame, displayed, floatsOf(band.displayed().data() - before), rows.width);
            addSlices(frame, invisible, floatsOf(band.invisible().data() - before), rows.width);
            addSlices(frame, visible, floatsOf(band.visible().data() - before), rows.width);
            for (std::size_t i = 0; i < layers.size(); ++i) {
                const LayerRows& layer = rows.layers[i];
                layers[i].resize(std::size_t{count} * rows.width * layer.channels.size());
                layer.read(y, layers[i]);
                addSlices(frame, channelsOf(layer.name, layer.channels),
                          layers[i].data() - before * layer.channels.size(), rows.width);
            }
            file.setFrameBuffer(frame);
            file.writePixels(static_cast<int>(count));
        }
    } catch (const std::exception&) {
        output.rethrow();  // the original exception, without OpenEXR's text around it
        throw;
    }
    output.rethrow();
}

namespace {

/// The size of a data window. `shift`: the index of its first pixel, counted from the pixel (0, 0).
struct Window {
    std::uint32_t width, height;
    std::ptrdiff_t shift;
};

/// Opens a file and calls read(input, window), which inserts slices and returns the image.
template <typename Read>
auto readExr(std::string_view bytes, const std::string& file, const Read& read) {
    static const bool kLimited = [] {
        Imf::Header::setMaxImageSize(kMaxImageSide, kMaxImageSide);
        return true;
    }();
    static_cast<void>(kLimited);
    checkExrHeader(bytes, file);
    try {
        MemoryInput memory(bytes);
        Imf::InputFile input(memory);
        const Imath::Box2i window = input.header().dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
        checkImageSize(width, height, bytes.size(), file);
        const std::ptrdiff_t shift = window.min.x + window.min.y * static_cast<std::ptrdiff_t>(width);
        return read(input,
                    Window{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), shift});
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        throw InputError(file, "", std::string("is not a readable OpenEXR image: ") + e.what(), "");
    }
}

void readPixels(Imf::InputFile& input, const Imf::FrameBuffer& frame) {
    const Imath::Box2i window = input.header().dataWindow();
    input.setFrameBuffer(frame);
    input.readPixels(window.min.y, window.max.y);
}

RadianceImage decode(std::string_view bytes, const std::string& file, bool displayedOnly) {
    return readExr(bytes, file, [&](Imf::InputFile& input, const Window& window) {
        const Imf::ChannelList& channels = input.header().channels();
        const ChannelNames displayed = channelsOf(""), invisible = channelsOf("invisible"),
                           visible = channelsOf("visible");
        const bool hasDisplayed = hasChannels(channels, displayed);
        const bool both = hasChannels(channels, invisible) && hasChannels(channels, visible) &&
                          !(displayedOnly && hasDisplayed);
        if (!both && !hasDisplayed) {
            throw InputError(file, "", "has no colour channels",
                             "expected R, G, B, or invisible.R/G/B and visible.R/G/B");
        }
        RadianceImage image = makeImage(window.width, window.height);
        Imf::FrameBuffer frame;
        if (both) addSlices(frame, invisible, floatsOf(image.invisible.data() - window.shift), image.width);
        addSlices(frame, both ? visible : displayed, floatsOf(image.visible.data() - window.shift),
                  image.width);
        readPixels(input, frame);
        return image;
    });
}

}  // namespace

RgbaImage decodeRgbaExr(std::string_view bytes, const std::string& file) {
    return readExr(bytes, file, [&](Imf::InputFile& input, const Window& window) {
        const Imf::ChannelList& channels = input.header().channels();
        const bool grey = !hasChannels(channels, channelsOf("")) && hasChannels(channels, {"Y"}) &&
                          channels.findChannel("RY") == nullptr;
        if (!grey && !hasChannels(channels, channelsOf("")))
            throw InputError(file, "", "has no colour channels", "expected R, G, B, or Y");
        RgbaImage image{window.width, window.height, {}};
        image.values.resize(std::size_t{4} * window.width * window.height);
        constexpr std::size_t kPixelBytes = 4 * sizeof(float);
        char* const origin = reinterpret_cast<char*>(image.values.data()) -
                             window.shift * static_cast<std::ptrdiff_t>(kPixelBytes);
        const auto slice = [&](std::size_t component) {
            constexpr double kOpaque = 1.0;  // for a missing alpha
            return Imf::Slice(Imf::FLOAT, origin + component * sizeof(float), kPixelBytes,
                              window.width * kPixelBytes, 1, 1, kOpaque);
        };
        Imf::FrameBuffer frame;
        frame.insert("A", slice(3));
        if (grey) {
            frame.insert("Y", slice(0));
        } else {
            for (const auto& [name, component] : {std::pair{"R", 0}, std::pair{"G", 1}, std::pair{"B", 2}})
                frame.insert(name, slice(static_cast<std::size_t>(component)));
        }
        readPixels(input, frame);
        for (std::size_t i = 0; grey && i < image.values.size(); i += 4)
            image.values[i + 1] = image.values[i + 2] = image.values[i];
        return image;
    });
}

RadianceImage decodeExr(std::string_view bytes, const std::string& file) {
    return decode(bytes, file, false);
}

RadianceImage decodeDisplayedExr(std::string_view bytes, const std::string& file) {
    return decode(bytes, file, true);
}

}  // namespace duolux
