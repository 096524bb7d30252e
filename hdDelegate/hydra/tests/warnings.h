// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/base/tf/diagnosticMgr.h>

#include <string>
#include <vector>

namespace patina {

/// Keeps what OpenUSD is warned of, instead of printing it.
class Warnings : public TfDiagnosticMgr::Delegate {
public:
    Warnings() { TfDiagnosticMgr::GetInstance().AddDelegate(this); }
    ~Warnings() override { TfDiagnosticMgr::GetInstance().RemoveDelegate(this); }

    std::vector<std::string> texts;

    /// @returns how many there were with some words
    int of(const std::string& words) const {
        int count = 0;
        for (const std::string& text : texts)
            count += text.find(words) != std::string::npos;
        return count;
    }

    void IssueError(const TfError&) override {}
    void IssueFatalError(const TfCallContext&, const std::string&) override {}
    void IssueStatus(const TfStatus&) override {}
    void IssueWarning(const TfWarning& warning) override {
        texts.push_back(warning.GetCommentary());
    }
};

} // namespace patina
