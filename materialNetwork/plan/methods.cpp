#include "materialNetwork/plan/methods.h"

namespace patina {

const std::vector<ChoicePoint>& choicePoints() {
    static const std::vector<ChoicePoint> points = {
        {"energyCompensation",
         {{"turquin", "rough microfacet lobes are scaled by what single scattering loses (Turquin "
                      "2019); white ones keep all energy; not reciprocal"},
          {"none", "single scattering only, as most renderers have it; a white metal of alpha 1 "
                   "loses about half of the light"},
          {"kullaConty", "a second lobe, shaped like diffuse, holds what is lost (Kulla and Conty "
                         "2017); reciprocal; lobes that reflect only, others as turquin"},
          {"randomWalk",
           "light bounces between the facets until it leaves (Heitz et al. 2016): the "
           "truth, noisier and slow; path tracer only, others as turquin"}},
         "randomWalk"},
        {"directionalAlbedo",
         {{"table", "looked up in baked tables: any roughness, ior, anisotropy and side"},
          {"fit", "three facets that stand in for all, from a small network: more exact than the "
                  "tables, and any Fresnel curve; isotropic GGX from the thinner side, else table"},
          {"karis", "Karis 2014: four constants and an exponential; too dark where smooth, and "
                    "every curve rises to white; from the thinner side, else table"},
          {"mirror", "the reflectance at the view's own cosine, as if the lobe were smooth"},
          {"monteCarlo16", "the mean over 16 visible facets, stratified"},
          {"monteCarlo64", "the mean over 64 visible facets, stratified"},
          {"quadrature", "the mean over 2304 facets: the truth, slow"}},
         "quadrature"},
        {"sampling",
         {{"vndf", "facets are drawn that the view sees (Heitz 2018, Dupuy and Benyoub 2023)"},
          {"boundedVndf", "of those, what can reflect upwards (Eto and Tokuyoshi 2023): fewer "
                          "samples lost where rough; GGX that reflects only, else vndf"},
          {"fullNdf",
           "all facets by their density (Walter et al. 2007): noisy at grazing angles"}}},
        {"fresnel",
         {{"exact", "the equations of dielectrics and conductors"},
          {"schlick", "Schlick's curve from the reflectance at normal incidence (1994): too bright "
                      "near ior 1 and above 2, too bright for metals near 80 degrees"},
          {"f82", "Schlick's curve with a dip that meets the exact reflectance at 82 degrees (Kutz "
                  "et al. 2021)"}},
         "exact"},
        {"thinFilm",
         {{"gaussian", "each order of interference through Gaussians fitted to what a channel sees "
                       "(Belcour and Barla 2017)"},
          {"table", "the same through tables of the transforms"},
          {"spectral", "Airy's formula at 144 wavelengths: the truth, slow; ripples for films of "
                       "more than 20 um"}},
         "spectral"},
        {"diffuse",
         {{"authored", "as energy_compensation of the node says: eon or qualitative"},
          {"lambert", "roughness is ignored"},
          {"qualitative", "Oren and Nayar 1994, the qualitative model: loses energy, and has a "
                          "ring where its minimum switches"},
          {"fujii", "Fujii's improved model: no ring, loses energy"},
          {"eon", "Portsmouth, Kutz and Hill 2025: white loses nothing"}}},
        {"sheen",
         {{"table", "what sheen of mode conty_kulla reflects in total is looked up; mode zeltner "
                    "has a formula by its definition"},
          {"fit", "a polynomial: no table, errors up to 0.004"},
          {"quadrature", "the sum over 2048 directions: the truth, slow"}},
         "quadrature"},
        {"layering",
         {{"albedoScaling",
           "a base is scaled by what the top's directional albedo leaves, as in MaterialX; what "
           "the top sends back down is counted as layerTransmittance says"},
          {"positionFree",
           "light bounces between an interface and its base until it leaves (Guo, Hasan and Zhao "
           "2018): the truth for interfaces, noisier and slow; path tracer only; under sheen, over "
           "subsurface and over the other half of one interface as albedoScaling"}},
         "positionFree"},
        {"subsurface",
         {{"randomWalk",
           "light scatters beneath the surface until it leaves the object: the truth; "
           "path tracer, as diffuse on the rasterizer and on thin walls"},
          {"diffuse",
           "light leaves where it entered, as from a diffuse surface of the same colour; "
           "edges and thin parts do not glow"}}},
        {"layerTransmittance",
         {{"returned",
           "each channel on its own, 1 - E with E the top's directional albedo without "
           "tint; what an interface sends back down meets the base again, so that a "
           "base of albedo A counts (1 - R) / (1 - A R) times, R what comes back; loses "
           "nothing over white, gains nothing"},
          {"largest", "a layer lets through 1 - E in all channels, E the largest channel of its "
                      "top's directional albedo without tint; no channel gains energy, and a tint "
                      "colours the top alone"},
          {"average", "1 - the mean of the channels, as in MaterialX's shaders; a coloured top may "
                      "give a channel more light than came"},
          {"tinted", "each channel on its own, with the tint: what the top does not reflect in a "
                     "channel is the base's, so that a red sheen lets blue through"}}},
        {"reflectionOverTransmission",
         {{"fused", "a reflection lobe layered over a transmission lobe is one interface: what the "
                    "top reflects is taken once, by the layer"},
          {"literal", "each node as it is defined: the layer takes the reflection, and the "
                      "transmission lobe leaves it out once more; glass darkens by 1 - F"}}},
        {"thinWalled",
         {{"slab", "a thin wall has two faces between which light bounces: it reflects 2 r / (1 + "
                   "r), passes (1 - r) / (1 + r) straight on, and absorbs nothing"},
          {"sheet", "a single face: it reflects r and passes 1 - r straight on"},
          {"solid", "thin_walled is ignored, as in MaterialX's shaders: the surface refracts and "
                    "bounds a medium"}}},
        {"domeLight",
         {{"sampled",
           "rasterizer: a few directions per pass with a shadow map each, and samples of "
           "the material; passes converge to the path tracer's direct light"},
          {"filtered",
           "rasterizer: each pass is free of noise: samples of the material look into "
           "smaller versions of the image (Krivanek and Colbert 2008); blurs highlights "
           "by the angle between samples"},
          {"prefiltered", "rasterizer: rough mirrors look into images made at load for five "
                          "roughnesses (split sum), diffuse surfaces into harmonics; cheapest, and "
                          "without the stretch of highlights at grazing angles"},
          {"harmonics", "rasterizer: diffuse and sheen by spherical harmonics of order 2 with the "
                        "dominant light apart, all else filtered; hides sharp changes of the sky's "
                        "light over the normal"},
          {"harmonicsUnwindowed",
           "rasterizer: the same with all of the sky in the harmonics and no window: to show that "
           "they ring, bright behind a sun and black beside it"}},
         "sampled"},
        {"environmentSamples",
         {{"16", "rasterizer: 16 samples of the material per pass look at domes, where they are "
                 "filtered; --environmentSamples takes any number from 4 to 1024"},
          {"4", "4 samples"},
          {"64", "64 samples"},
          {"256", "256 samples"},
          {"1024", "1024 samples"}}},
        {"areaLight",
         {{"sampled", "rasterizer: a place on each light per pass, and samples of the material; "
                      "passes converge to the path tracer's direct light"},
          {"linearlyTransformedCosines",
           "rasterizer: the outline of each light through a linear map of the lobe (Heitz et al. "
           "2016), free of noise but for shadows; lights with an image, a profile or a cone, and "
           "materials with anisotropic or other lobes than diffuse, sheen and facets are sampled; "
           "no roughness of diffuse lobes, and no stretch of Fresnel's over a lobe"}},
         "sampled"},
        {"subdivision",
         {{"4px",
           "subdivision surfaces are refined until no edge is longer on screen than 4 pixels"},
          {"16px", "16 pixels: outlines are seen to have corners"},
          {"8px", "8 pixels"},
          {"2px", "2 pixels"},
          {"1px", "1 pixel"},
          {"0.5px", "half a pixel: the truth, as far as a million triangles of a prim and six "
                    "levels go"}},
         "0.5px"},
        {"pathDepth",
         {{"16", "paths meet 16 surfaces at most: what is left of the light after so many as white "
                 "as the whitest is missing"},
          {"4", "4 surfaces"},
          {"8", "8 surfaces"},
          {"32", "32 surfaces"},
          {"64", "64 surfaces"},
          {"128", "128 surfaces"},
          {"256", "256 surfaces"},
          {"512", "512 surfaces"},
          {"1024", "1024 surfaces: the truth, unless they absorb next to nothing"}},
         "1024"},
        {"roulette",
         {{"throughput", "after --rouletteDepth surfaces a path goes on with the chance of four "
                         "times what is left of its light, 0.95 at most, and counts more"},
          {"none", "no path is ended by chance, only by its depth: less noise of a sample, which "
                   "takes longer"}}}};
    return points;
}

std::string chosenMethod(const MethodChoices& choices, const std::string& point) {
    const auto found = choices.find(point);
    if (found != choices.end()) return found->second;
    for (const ChoicePoint& choice : choicePoints())
        if (choice.name == point) return choice.methods.front().name;
    return "";
}

std::string truthMethod(const std::string& point) {
    for (const ChoicePoint& choice : choicePoints())
        if (choice.name == point) return choice.truth;
    return "";
}

int chosenIndex(const MethodChoices& choices, const std::string& point) {
    const std::string chosen = chosenMethod(choices, point);
    for (const ChoicePoint& choice : choicePoints())
        if (choice.name == point)
            for (size_t i = 0; i < choice.methods.size(); ++i)
                if (choice.methods[i].name == chosen) return int(i);
    return 0;
}

std::string checkMethods(const MethodChoices& choices) {
    for (const auto& item : choices) {
        const ChoicePoint* point = nullptr;
        std::string known;
        for (const ChoicePoint& candidate : choicePoints()) {
            known += (known.empty() ? "" : ", ") + candidate.name;
            if (candidate.name == item.first) point = &candidate;
        }
        if (!point)
            return "there is no choice point '" + item.first + "' (there are: " + known + ")";
        known.clear();
        bool found = false;
        for (const Method& method : point->methods) {
            known += (known.empty() ? "" : ", ") + method.name;
            found |= method.name == item.second;
        }
        if (!found)
            return "the choice point '" + item.first + "' has no method '" + item.second +
                   "' (it has: " + known + ")";
    }
    return "";
}

} // namespace patina
