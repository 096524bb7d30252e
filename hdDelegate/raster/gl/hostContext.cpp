// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/hostContext.h"

#include "hdDelegate/raster/gl/heldFences.h"

namespace patina {

std::shared_ptr<HostContext> HostContext::current(std::string& why) {
    why.clear();
    auto made = std::make_shared<HostContext>();
    made->_host = currentNativeContext();
    if (!made->_host) return nullptr;
    made->_own = GlContext::sharingCurrent(why);
    if (!made->_own) return nullptr;
    if (HeldFences::neededBy(made->_own->renderer()) && eglHasHardware()) {
        why = "the host draws by software, and there is a graphics processor";
        return nullptr;
    }
    return made;
}

bool HostContext::use(const std::function<void()>& function) const {
    if (isCurrent()) { // which knows the same objects
        function();
        return true;
    }
    const std::lock_guard<std::mutex> lock(_mutex);
    const GlContext::Use use(*_own);
    if (use.ok()) function();
    return use.ok();
}

} // namespace patina
