// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace patina {

/// The graphics device of a host, as one of its threads uses it. Back ends that know it draw images
/// which the host can copy without a way through memory (DeviceImage).
class HostDevice {
public:
    virtual ~HostDevice() = default;
    /// Whether the host's context is current on this thread.
    virtual bool isCurrent() const = 0;
};

} // namespace patina
