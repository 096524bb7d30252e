// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/edits/baseStage.h"

#include <stdexcept>
#include <string>

namespace patina {

namespace {

const char* const geometryText = R"(
    def Scope "geometry"
    {
        def Mesh "ground" (prepend apiSchemas = ["MaterialBindingAPI"])
        {
            int[] faceVertexCounts = [4]
            int[] faceVertexIndices = [0, 1, 2, 3]
            point3f[] points = [(-4, 0, 4), (4, 0, 4), (4, 0, -4), (-4, 0, -4)]
            uniform token subdivisionScheme = "none"
            rel material:binding = </World/materials/standard>
        }
        def Mesh "polygons" (prepend apiSchemas = ["MaterialBindingAPI"])
        {
            int[] faceVertexCounts = [4, 3]
            int[] faceVertexIndices = [0, 1, 2, 3, 2, 1, 4]
            point3f[] points = [(-1, 0.2, 0), (0, 0.2, 0), (0, 1, 0), (-1, 1, 0), (0.6, 0.6, 0.2)]
            texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1), (2, 1)] (
                interpolation = "vertex"
            )
            uniform token subdivisionScheme = "none"
            rel material:binding = </World/materials/preview>
        }
        def Mesh "subdivided" (prepend apiSchemas = ["MaterialBindingAPI"])
        {
            int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
            int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
            point3f[] points = [(1, 0.2, 0), (2, 0.2, 0), (1, 1.2, 0), (2, 1.2, 0), (1, 0.2, 1), (2, 0.2, 1), (1, 1.2, 1), (2, 1.2, 1)]
            rel material:binding = </World/materials/closure>
            def GeomSubset "part" (prepend apiSchemas = ["MaterialBindingAPI"])
            {
                uniform token elementType = "face"
                uniform token familyName = "materialBind"
                int[] indices = [1, 3]
                rel material:binding = </World/materials/preview>
            }
        }
        def Sphere "sphere" (prepend apiSchemas = ["MaterialBindingAPI"])
        {
            double radius = 0.4
            double3 xformOp:translate = (-1.5, 0.5, 1)
            uniform token[] xformOpOrder = ["xformOp:translate"]
            rel material:binding = </World/materials/standard>
        }
        def Cube "cube"
        {
            double size = 0.5
            double3 xformOp:translate = (0, 0.3, 1.2)
            uniform token[] xformOpOrder = ["xformOp:translate"]
            color3f[] primvars:displayColor = [(0.8, 0.3, 0.1)]
        }
        def Plane "pane"
        {
            double width = 0.5
            double length = 0.8
            double3 xformOp:translate = (1, 0.6, 1.2)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
        def BasisCurves "curves"
        {
            int[] curveVertexCounts = [4, 4]
            point3f[] points = [(-2, 0, 0), (-2, 1, 0), (-1.5, 1, 0), (-1.5, 2, 0), (-2.4, 0, 0), (-2.4, 1, 0), (-2.2, 1, 0), (-2, 2, 0)]
            float[] widths = [0.1] (interpolation = "constant")
            uniform token type = "cubic"
            uniform token basis = "bspline"
        }
        def Points "points"
        {
            point3f[] points = [(0.5, 1.5, 0), (0.8, 1.4, 0.3), (1.1, 1.6, 0)]
            float[] widths = [0.2, 0.3, 0.1]
        }
    }
)";

const char* const instancesText = R"(
    def PointInstancer "instancer"
    {
        int[] protoIndices = [0, 1, 0]
        point3f[] positions = [(-2, 0.2, 2), (-1, 0.2, 2), (0, 0.2, 2)]
        quath[] orientations = [(1, 0, 0, 0), (0.92, 0, 0.38, 0), (1, 0, 0, 0)]
        rel prototypes = [</World/instancer/block>, </World/instancer/cluster>]
        def Mesh "block"
        {
            int[] faceVertexCounts = [4, 4]
            int[] faceVertexIndices = [0, 1, 2, 3, 3, 2, 5, 4]
            point3f[] points = [(-0.2, 0, 0), (0.2, 0, 0), (0.2, 0.3, 0), (-0.2, 0.3, 0), (-0.2, 0.3, -0.3), (0.2, 0.3, -0.3)]
            uniform token subdivisionScheme = "none"
        }
        def PointInstancer "cluster"
        {
            int[] protoIndices = [0, 0]
            point3f[] positions = [(0, 0, 0), (0.25, 0, 0.1)]
            float3[] scales = [(1, 1, 1), (0.5, 0.8, 0.5)]
            rel prototypes = </World/instancer/cluster/pebble>
            def Sphere "pebble"
            {
                double radius = 0.12
            }
        }
    }
    def Xform "native"
    {
        def "a" (
            instanceable = true
            references = </Library/thing>
        )
        {
            double3 xformOp:translate = (2, 0, 2)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
        def "b" (
            instanceable = true
            references = </Library/thing>
        )
        {
            double3 xformOp:translate = (2.6, 0, 1.4)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
    }
)";

const char* const lightsText = R"(
    def Scope "lights"
    {
        def RectLight "key"
        {
            float inputs:intensity = 12
            float inputs:width = 2
            float inputs:height = 1
            double3 xformOp:translate = (0, 4, 1)
            float xformOp:rotateX = -80
            uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
        }
        def SphereLight "bulb"
        {
            float inputs:intensity = 20
            float inputs:radius = 0.2
            double3 xformOp:translate = (-3, 2, 2)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
        def DistantLight "sun"
        {
            float inputs:intensity = 2
            float inputs:angle = 3
            float xformOp:rotateX = -50
            uniform token[] xformOpOrder = ["xformOp:rotateX"]
        }
        def DomeLight "sky"
        {
            float inputs:intensity = 0.3
        }
    }
)";

const char* const materialsText = R"(
    def Scope "materials"
    {
        def Material "preview"
        {
            token outputs:surface.connect = </World/materials/preview/surface.outputs:surface>
            def Shader "surface"
            {
                uniform token info:id = "UsdPreviewSurface"
                color3f inputs:diffuseColor = (0.2, 0.5, 0.7)
                float inputs:roughness = 0.4
                token outputs:surface
            }
            def Shader "reader"
            {
                uniform token info:id = "UsdPrimvarReader_float3"
                string inputs:varname = "displayColor"
                float3 inputs:fallback = (0.9, 0.1, 0.2)
                float3 outputs:result
            }
        }
        def Material "standard"
        {
            token outputs:mtlx:surface.connect = </World/materials/standard/surface.outputs:out>
            def Shader "surface"
            {
                uniform token info:id = "ND_standard_surface_surfaceshader"
                color3f inputs:base_color = (0.6, 0.55, 0.5)
                float inputs:specular_roughness = 0.3
                token outputs:out
            }
        }
        def Material "closure"
        {
            token outputs:mtlx:surface.connect = </World/materials/closure/surface.outputs:out>
            def Shader "diffuse"
            {
                uniform token info:id = "ND_oren_nayar_diffuse_bsdf"
                color3f inputs:color = (0.7, 0.4, 0.2)
                token outputs:out
            }
            def Shader "gloss"
            {
                uniform token info:id = "ND_dielectric_bsdf"
                float2 inputs:roughness = (0.1, 0.1)
                token outputs:out
            }
            def Shader "layer"
            {
                uniform token info:id = "ND_layer_bsdf"
                token inputs:top.connect = </World/materials/closure/gloss.outputs:out>
                token inputs:base.connect = </World/materials/closure/diffuse.outputs:out>
                token outputs:out
            }
            def Shader "surface"
            {
                uniform token info:id = "ND_surface"
                token inputs:bsdf.connect = </World/materials/closure/layer.outputs:out>
                token outputs:out
            }
        }
    }
)";

const char* const restText = R"(
    def Scope "cameras"
    {
        def Camera "main"
        {
            float2 clippingRange = (0.1, 1000)
            float focalLength = 30
            float horizontalAperture = 24
            float verticalAperture = 24
            double3 xformOp:translate = (0, 2, 8)
            float xformOp:rotateX = -10
            uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
        }
        def Camera "side"
        {
            float2 clippingRange = (0.1, 1000)
            float focalLength = 30
            float horizontalAperture = 24
            float verticalAperture = 24
            double3 xformOp:translate = (7, 3, 1)
            float3 xformOp:rotateXYZ = (-20, 80, 0)
            uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
        }
    }
    def Xform "variants" (
        variants = {
            string look = "cone"
        }
        prepend variantSets = "look"
    )
    {
        double3 xformOp:translate = (-0.5, 0.4, 2.8)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        variantSet "look" = {
            "cone" {
                def Cone "shape"
                {
                    double height = 0.7
                    double radius = 0.3
                }
            }
            "capsule" {
                def Capsule "shape"
                {
                    double height = 0.3
                    double radius = 0.2
                }
            }
            "none" {
            }
        }
    }
    def Scope "extra"
    {
    }
)";

const char* const libraryText = R"(
class "Library"
{
    def Xform "thing"
    {
        def Cylinder "post"
        {
            double height = 0.6
            double radius = 0.1
            double3 xformOp:translate = (0, 0.3, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
        def Mesh "flag"
        {
            int[] faceVertexCounts = [3]
            int[] faceVertexIndices = [0, 1, 2]
            point3f[] points = [(0, 0.4, 0.1), (0.4, 0.5, 0.1), (0, 0.6, 0.1)]
            uniform token subdivisionScheme = "none"
            color3f[] primvars:displayColor = [(0.1, 0.7, 0.2)]
        }
    }
}
)";

} // namespace

UsdStageRefPtr makeBaseStage() {
    const std::string text =
        std::string("#usda 1.0\n(\n    upAxis = \"Y\"\n)\ndef Xform \"World\"\n{") + geometryText +
        instancesText + lightsText + materialsText + restText + "}\n" + libraryText;
    const SdfLayerRefPtr layer = SdfLayer::CreateAnonymous("edited.usda");
    if (!layer->ImportFromString(text)) throw std::runtime_error("the base stage is no USD");
    const UsdStageRefPtr stage = UsdStage::Open(layer);
    if (!stage) throw std::runtime_error("the base stage cannot be opened");
    return stage;
}

} // namespace patina
