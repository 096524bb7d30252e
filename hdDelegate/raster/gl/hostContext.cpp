// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/hostContext.h"

namespace patina {

std::shared_ptr<HostContext> HostContext::current(std::string& why) {
    auto made = std::make_shared<HostContext>();
    made->_host = currentNativeContext();
    made->_own = GlContext::sharingCurrent(why);
    return made->_own ? made : nullptr;
}

bool HostContext::use(const std::function<void()>& function) const {
    const std::lock_guard<std::mutex> lock(_mutex);
    const GlContext::Use use(*_own);
    if (use.ok()) function();
    return use.ok();
}

} // namespace patina
