// SPDX-License-Identifier: Apache-2.0

// An element with properties and children; texts become text nodes, never markup.
export function element(tag, properties = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(properties))
        if (name in made) made[name] = value; else made.setAttribute(name, value);
    made.append(...children.filter(child => child !== null));
    return made;
}
