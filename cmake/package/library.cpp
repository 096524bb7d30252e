// libpatina.so is made of the rooms' own libraries; a target wants one file.
