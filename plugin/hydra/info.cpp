// SPDX-License-Identifier: Apache-2.0
// patinaHydraInfo: where the plugin is, which OpenUSD it runs in, and why a host would refuse it.

#include "hdDelegate/hydra/compat.h"
#include "plugin/hydra/support.h"

#include <pxr/base/plug/plugin.h>
#include <pxr/base/plug/registry.h>
#include <pxr/base/tf/getenv.h>
#include <pxr/base/tf/stringUtils.h>
#include <pxr/imaging/hd/renderDelegate.h>
#include <pxr/imaging/hd/rendererPlugin.h>
#include <pxr/imaging/hd/rendererPluginRegistry.h>

#include <cstdio>
#include <string>

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

void print(const char* what, const std::string& value) {
    std::printf("%-22s %s\n", what, value.c_str());
}

int fail(const std::string& reason) {
    print("usable", "no: " + reason);
    return 1;
}

} // namespace

int main() {
    const int version = PXR_VERSION;
    print("built for OpenUSD", TfStringPrintf("%d.%02d, HD_API_VERSION %d", version / 100,
                                              version % 100, HD_API_VERSION));
    print("PXR_PLUGINPATH_NAME", TfGetenv("PXR_PLUGINPATH_NAME", "(not set)"));
    const PlugPluginPtr plugin = PlugRegistry::GetInstance().GetPluginWithName("hdPatina");
    if (!plugin)
        return fail("hosts do not find it; set PXR_PLUGINPATH_NAME to the folder that holds "
                    "plugInfo.json and hdPatina (" PATINA_PLUGIN_SUBFOLDER
                    " below the place of installation)");
    print("plugin", plugin->GetPath());
    print("resources", plugin->GetResourcePath());
    if (!plugin->Load()) return fail("the library cannot be loaded (see the message above)");
    std::string reason;
    if (!patina::isSupported(&reason)) return fail(reason);

    const TfToken id("HdPatinaRendererPlugin");
    HdRendererPluginRegistry& registry = HdRendererPluginRegistry::GetInstance();
    HfPluginDesc description;
    if (!registry.GetPluginDesc(id, &description))
        return fail("the library is loaded, but registers no renderer");
    print("name in hosts", description.displayName);
    print("priority", std::to_string(description.priority));
    HdRendererPlugin* renderer = registry.GetRendererPlugin(id);
    if (!renderer) return fail("the renderer plugin cannot be made");
    HdRenderDelegate* delegate = renderer->CreateRenderDelegate();
    const bool started = delegate != nullptr;
    if (started) {
        print("render settings", std::to_string(delegate->GetRenderSettingDescriptors().size()));
        renderer->DeleteRenderDelegate(delegate);
    }
    registry.ReleasePlugin(renderer);
    if (!started) return fail("the renderer does not start (see the message above)");
    print("usable", "yes");
    return 0;
}
