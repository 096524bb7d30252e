// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/textureSystem.h"

#include "hdDelegate/image/iesProfile.h"
#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace fs = std::filesystem;

namespace patina {

namespace {

const glm::vec4 magenta(1, 0, 1, 1);
constexpr int firstTile = 1001, lastTile = 9999;

/// Tokens of a file name that stand for a tile: its number, or Mudbox's "u1_v1".
const std::string tileTokens[] = {"<UDIM>", "<UVTILE>"};

std::string tileName(int token, int tile) {
    if (token == 0) return std::to_string(tile);
    const int place = tile - firstTile;
    return "u" + std::to_string(place % 10 + 1) + "_v" + std::to_string(place / 10 + 1);
}

constexpr int mostTokens = 16; ///< in a name; no tile of others is looked for

int tokensIn(const std::string& pattern) {
    int count = 0;
    for (const std::string& token : tileTokens)
        for (size_t at = 0; (at = pattern.find(token, at)) != std::string::npos; ++count)
            at += token.size();
    return count;
}

bool isTiled(const std::string& file) {
    return tokensIn(file) > 0;
}

std::string withTile(std::string file, int tile) {
    for (int token = 0; token < 2; ++token)
        for (size_t at = 0; (at = file.find(tileTokens[token], at)) != std::string::npos;)
            file.replace(at, tileTokens[token].size(), tileName(token, tile));
    return file;
}

/// The tiles of a name with a token that exist, in order.
std::vector<int> existingTiles(const std::string& pattern) {
    std::vector<int> tiles;
    if (tokensIn(pattern) > mostTokens) return tiles;
    const std::string& udim = tileTokens[0];
    fs::path path(pattern);
    std::string name = path.filename().string();
    size_t at = name.find(udim);
    std::error_code error;
    if (at == std::string::npos || tokensIn(pattern) > 1) {
        for (int tile = firstTile; tile < firstTile + 100; ++tile)
            if (fs::exists(withTile(pattern, tile), error)) tiles.push_back(tile);
        return tiles;
    }
    // One look at the folder instead of thousands of guesses.
    std::string start = name.substr(0, at), end = name.substr(at + udim.size());
    fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (fs::directory_iterator i(folder, error), last; !error && i != last; i.increment(error)) {
        std::string file = i->path().filename().string();
        if (file.size() != start.size() + 4 + end.size() || file.compare(0, at, start) != 0 ||
            file.compare(at + 4, end.size(), end) != 0)
            continue;
        int tile = 0;
        for (size_t c = at; c < at + 4 && tile >= 0; ++c)
            tile = std::isdigit((unsigned char)file[c]) ? tile * 10 + (file[c] - '0') : -1;
        if (tile >= firstTile && tile <= lastTile) tiles.push_back(tile);
    }
    std::sort(tiles.begin(), tiles.end());
    return tiles;
}

/// Replaces the modes of a request that are the file's business by what the file says.
/// @param modes "black", "clamp,mirror", as OpenImageIO names them; others leave the request's
void takeOwnModes(const std::string& modes, TextureRequest& request) {
    static const std::map<std::string, TextureWrap> names = {
        {"black", TextureWrap::Black},
        {"clamp", TextureWrap::Clamp},
        {"mirror", TextureWrap::Mirror},
        {"periodic", TextureWrap::Repeat},
        {"repeat", TextureWrap::Repeat},
        {"periodic_pow2", TextureWrap::Repeat},
        {"periodic_sharedborder", TextureWrap::Repeat}};
    const size_t comma = modes.find(',');
    const auto take = [&](std::string name, TextureWrap& to) {
        name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
        const auto found = names.find(name);
        if (found != names.end()) to = found->second;
    };
    if (request.ownWrapS) take(modes.substr(0, comma), request.wrapS);
    if (request.ownWrapT)
        take(comma == std::string::npos ? modes : modes.substr(comma + 1), request.wrapT);
}

} // namespace

/// A file in a colour space; read once, by the first thread that wants a texel.
struct TextureSystem::Image {
    ImageSource source;
    const ColorSpaces& colorSpaces;
    Diagnostics& diagnostics;
    TextureMemory& memory;
    ImageHeader header;
    std::string problem; ///< of the header

    mutable std::once_flag once;
    mutable std::shared_ptr<ImageTexture> texture;
    mutable std::atomic<bool> loaded{false};
    mutable std::mutex wholeMutex;
    mutable std::weak_ptr<const ImageTexture> wholeTexture; ///< where `texture` is not

    Image(const ImageSource& s, const ColorSpaces& c, Diagnostics& d, TextureMemory& m)
        : source(s), colorSpaces(c), diagnostics(d), memory(m), header(probeImage(s.file)),
          problem(header.problem) {
        if (problem.empty() && !header.tooLarge.empty() && !memory.isSet())
            problem = header.tooLarge + "; --textureMemory reads larger ones";
        if (problem.empty()) memory.opened(header.bytes);
    }

    const ImageTexture* get() const {
        if (!loaded.load(std::memory_order_acquire)) load();
        return texture.get();
    }
    void load() const {
        std::call_once(once, [this] {
            if (problem.empty()) texture = read();
            loaded.store(true, std::memory_order_release);
        });
    }
    std::shared_ptr<ImageTexture> read() const {
        if (!header.tooLarge.empty() || !memory.takeWhole(header.bytes))
            return openTiledTexture(source, colorSpaces, memory.store(), diagnostics);
        std::shared_ptr<ImageTexture> whole = loadImageTexture(source, colorSpaces, diagnostics);
        memory.correctWhole(header.bytes, whole ? whole->memoryBytes() : 0);
        return whole;
    }
    std::shared_ptr<const ImageTexture> whole() const {
        if (!get() || texture->isWhole()) return texture;
        const std::lock_guard<std::mutex> lock(wholeMutex);
        std::shared_ptr<const ImageTexture> held = wholeTexture.lock();
        if (!held) wholeTexture = held = loadImageTexture(source, colorSpaces, diagnostics);
        return held;
    }
};

struct TextureSystem::Entry {
    TextureRequest request;
    const RenderingSpace* renderingSpace = nullptr;
    bool udim = false, valid = false;
    std::vector<std::shared_ptr<Image>> tiles; ///< one, or by UDIM number with gaps
    size_t watched = 0;                        ///< tiles that are warned of one by one
    mutable std::unique_ptr<std::atomic<bool>[]>
        warned; ///< per watched tile; the last for the rest

    ImageSource source(const std::string& file) const {
        return {file, request.colorSpace, request.prim, request.input, false, renderingSpace};
    }
    const Image* firstImage() const {
        for (auto& image : tiles)
            if (image && image->problem.empty()) return image.get();
        return nullptr;
    }
};

TextureSystem::TextureSystem(Diagnostics& diagnostics, const ColorSpaces& colorSpaces)
    : _diagnostics(diagnostics), _colorSpaces(colorSpaces) {
    const auto& problem = ColorSpaces::sharedProblem();
    if (problem && &colorSpaces == &ColorSpaces::shared()) diagnostics.warn("", "OCIO", *problem);
}

TextureSystem::~TextureSystem() = default;

void TextureSystem::setMemory(uint64_t bytes) {
    _memory.setBytes(bytes);
}

std::shared_ptr<TextureSystem::Image> TextureSystem::shareImage(const ImageSource& source) {
    std::shared_ptr<Image>& image =
        _images[source.file + '\n' + source.colorSpace + '\n' + source.renderingSpace->name];
    if (!image) image = std::make_shared<Image>(source, _colorSpaces, _diagnostics, _memory);
    image->source.finestOnly = _finestOnly;
    return image;
}

void TextureSystem::openTiles(Entry& entry) {
    const std::string& file = entry.request.file;
    entry.udim = isTiled(file);
    if (!entry.udim) {
        entry.tiles.push_back(shareImage(entry.source(file)));
        return;
    }
    std::vector<int> tiles = existingTiles(file);
    if (!tiles.empty()) entry.tiles.resize(size_t(tiles.back() - firstTile) + 1);
    for (int tile : tiles)
        entry.tiles[size_t(tile - firstTile)] = shareImage(entry.source(withTile(file, tile)));
    entry.watched = std::max<size_t>(entry.tiles.size(), 100);
    entry.warned.reset(new std::atomic<bool>[entry.watched + 1]());
}

std::shared_ptr<const EmissionProfile> TextureSystem::openProfile(const TextureRequest& request) {
    std::lock_guard<std::mutex> lock(_mutex);
    const auto known = _profiles.find(request.file);
    if (known != _profiles.end()) return known->second;
    auto profile = std::make_shared<IesProfile>();
    std::string error;
    if (!profile->load(request.file, error)) {
        _diagnostics.warn(request.prim, request.input,
                          messages::emissionUnshaped(request.file, error));
        profile = nullptr;
    }
    _profiles[request.file] = profile;
    return profile;
}

int TextureSystem::open(const TextureRequest& request) {
    std::string key = request.file + '\n' + request.colorSpace + '\n' +
                      _renderingSpace.load()->name + '\n' + char('0' + int(request.wrapS)) +
                      char('0' + int(request.wrapT)) + (request.nearest ? 'n' : 'l') +
                      (request.ownWrapS ? 's' : '-') + (request.ownWrapT ? 't' : '-');
    std::lock_guard<std::mutex> lock(_mutex);
    auto known = _handles.find(key);
    int handle = known == _handles.end() ? -1 : known->second;
    if (handle < 0) {
        auto entry = std::make_unique<Entry>();
        entry->request = request;
        entry->renderingSpace = _renderingSpace;
        openTiles(*entry);
        entry->valid = entry->firstImage() != nullptr;
        if (entry->valid) takeOwnModes(entry->firstImage()->header.wrapModes, entry->request);
        handle = int(_entries.push_back(std::move(entry)) - _entries.begin());
        _handles[key] = handle;
        _count.store(handle + 1, std::memory_order_release);
    }
    const Entry& entry = *_entries[size_t(handle)];
    if (!entry.valid) {
        // Everyone who asks is named: each of them shows magenta.
        std::string reason = entry.tiles.empty() ? "no tile of it exists" : "no tile can be read";
        if (!entry.udim) reason = entry.tiles[0]->problem;
        _diagnostics.warn(request.prim, request.input,
                          messages::textureFallback(request.file, reason));
    }
    return handle;
}

bool TextureSystem::valid(int handle) const {
    return handle >= 0 && handle < _count.load(std::memory_order_acquire) &&
           _entries[size_t(handle)]->valid;
}

int TextureSystem::channels(int handle) const {
    const Image* image = valid(handle) ? _entries[size_t(handle)]->firstImage() : nullptr;
    return image ? channelCount(image->header.layout) : 4;
}

TextureTiling TextureSystem::tiling(int handle) const {
    TextureTiling out;
    if (!valid(handle)) return out;
    const Entry& entry = *_entries[size_t(handle)];
    out.wrapS = entry.request.wrapS;
    out.wrapT = entry.request.wrapT;
    for (size_t i = 0; entry.udim && i < entry.tiles.size(); ++i)
        if (entry.tiles[i] && entry.tiles[i]->problem.empty())
            out.tiles.push_back(firstTile + int(i));
    return out;
}

const TextureSystem::Image* TextureSystem::tileAt(const Entry& entry, glm::vec2& uv) const {
    if (!entry.udim) return entry.tiles[0].get();
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = glm::vec2(0);
    glm::vec2 corner = glm::floor(uv), local = uv - corner;
    auto find = [&](float column, float row) -> const Image* {
        if (!(column >= 0 && column < 10 && row >= 0 && row < 1000)) return nullptr;
        size_t i = size_t(column) + 10 * size_t(row);
        return i < entry.tiles.size() ? entry.tiles[i].get() : nullptr;
    };
    const Image* image = find(corner.x, corner.y);
    // The far edge of a tile, at a whole number, belongs to it when there is no next one.
    for (int edge = 1; !image && edge < 4; ++edge) {
        bool s = edge & 1, t = edge & 2;
        if ((s && local.x != 0) || (t && local.y != 0)) continue;
        image = find(corner.x - float(s), corner.y - float(t));
        if (image) local += glm::vec2(s, t);
    }
    if (image) {
        uv = local;
        return image;
    }
    bool inside = corner.x >= 0 && corner.x < 10 && corner.y >= 0 && corner.y < 1000;
    size_t number = inside ? size_t(corner.x) + 10 * size_t(corner.y) : entry.watched;
    auto& warned = entry.warned[std::min(number, entry.watched)];
    if (!warned.exchange(true, std::memory_order_relaxed)) {
        std::string which = inside ? "tile " + std::to_string(firstTile + int(number))
                                   : std::string("tile at some texture coordinates");
        _diagnostics.warn(entry.request.prim, entry.request.input,
                          messages::tileMissing(entry.request.file, which));
    }
    return nullptr;
}

glm::vec4 TextureSystem::sample(int handle, glm::vec2 uv, float footprint) const {
    if (!valid(handle)) return magenta;
    const Entry& entry = *_entries[size_t(handle)];
    const Image* image = tileAt(entry, uv);
    const ImageTexture* texture = image ? image->get() : nullptr;
    if (!texture) return magenta;
    if (_finestOnly) footprint = 0.0f;
    TextureWrap s = entry.udim ? TextureWrap::Clamp : entry.request.wrapS;
    TextureWrap t = entry.udim ? TextureWrap::Clamp : entry.request.wrapT;
    return entry.request.nearest ? texture->sampleNearest(uv, s, t)
                                 : texture->sample(uv, footprint, s, t);
}

std::shared_ptr<const ImageTexture> TextureSystem::image(int handle, int tile) const {
    if (!valid(handle)) return nullptr;
    const Entry& entry = *_entries[size_t(handle)];
    size_t i = entry.udim ? size_t(std::max(0, tile - firstTile)) : 0;
    if (i >= entry.tiles.size() || !entry.tiles[i]) return nullptr;
    return entry.tiles[i]->whole();
}

const TextureRequest& TextureSystem::request(int handle) const {
    return _entries[size_t(handle)]->request;
}

void TextureSystem::loadAll() const {
    std::vector<const Image*> images;
    for (auto& entry : _entries)
        for (auto& image : entry->tiles)
            if (image) images.push_back(image.get());
    parallelFor(size_t(0), images.size(), [&](size_t i) { images[i]->get(); });
}

size_t TextureSystem::memoryBytes() const {
    const TextureMemory::Counts counts = _memory.counts();
    return counts.whole + counts.tiles;
}

} // namespace patina
