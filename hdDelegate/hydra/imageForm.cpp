// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/imageForm.h"

#include "hdDelegate/hydra/pixelFormats.h"

#include <algorithm>
#include <cstring>

namespace patina {

void HdPatinaImageForm::read(const Film& film, HdPatinaPixels& result) const {
    AovSpec spec;
    const bool found = film.width() > 0 && !aov.empty() && film.findSpec(aov, spec);
    const size_t first = layer > 0 ? 4 * size_t(layer) : 0;
    const int shown = layer < 0 ? spec.components : std::min(spec.components - int(first), 4);
    const bool known =
        found && shown > 0 && shown <= 4 && format != HdFormatInvalid; // rows have four floats
    result.device.reset();
    if (known && readFromSource(film, spec, result)) return;
    std::vector<uint8_t>& bytes = result.bytes;
    bytes.resize(known ? size_t(width) * size_t(height) * HdDataSizeOfFormat(format) : 0);
    if (bytes.empty()) return;
    const bool isColor = spec.id == AovId::color, replaced = replaces(spec);
    const std::vector<float> pixels = film.resolve(aov);
    const std::vector<float> alpha = isColor ? film.resolve("alpha") : std::vector<float>();
    fillPixels(bytes.data(), width, height, spec.isInteger, format, [&](int y, float* out) {
        if (y >= film.height()) return;
        size_t i = size_t(film.height() - 1 - y) * size_t(film.width());
        const size_t end = i + std::min(width, unsigned(film.width()));
        for (; i < end; ++i, out += 4) {
            std::copy_n(&pixels[i * size_t(spec.components) + first], shown, out);
            if (isColor) {
                out[3] = alpha[i];
                for (int k = 0; k < 4 && !clear.empty; ++k)
                    out[k] += (1.0f - alpha[i]) * clear.values[k];
            } else if (replaced && std::memcmp(out, &spec.clearValue, sizeof(float)) == 0) {
                out[0] = clear.values[0];
            }
        }
    });
}

bool HdPatinaImageForm::readFromSource(const Film& film, const AovSpec& spec,
                                       HdPatinaPixels& pixels) const {
    const FilmSource* source = film.source();
    if (!source || !source->has(spec.id) || int(width) != film.width() ||
        int(height) != film.height())
        return false;
    PixelForm form;
    switch (HdGetComponentFormat(format)) {
    case HdFormatFloat16: form.type = PixelForm::Type::Half; break;
    case HdFormatFloat32: form.type = PixelForm::Type::Float; break;
    case HdFormatInt32: form.type = PixelForm::Type::Int; break;
    default: return false;
    }
    form.components = int(HdGetComponentCount(format));
    form.bottomFirst = true;
    if (!clear.empty)
        form.background = {clear.values[0], clear.values[1], clear.values[2], clear.values[3]};
    form.nothing = replaces(spec) ? clear.values[0] : spec.clearValue;
    if (onDevice) {
        form.depth = pixels.isDepth = spec.id == AovId::deviceDepth;
        pixels.device = source->draw(spec.id, form);
        if (pixels.device) return true;
        form.depth = false;
    }
    pixels.bytes.resize(size_t(width) * size_t(height) * HdDataSizeOfFormat(format));
    return source->read(spec.id, form, pixels.bytes.data());
}

} // namespace patina
